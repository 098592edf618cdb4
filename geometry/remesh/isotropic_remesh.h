#pragma once

#include <optional>

#include "core/triangle_mesh.h"

namespace fracbench {

/// One run of isotropic remeshing with CGAL towards `edge_length`, m, that keeps the lines where
/// normals differ by more than `feature_angle`, degrees. Whether the result crosses itself is not
/// tested. Nothing where the library cannot handle the mesh.
std::optional<TriangleMesh> isotropic_remesh(const TriangleMesh& mesh, double edge_length,
                                             double feature_angle);

enum class CollapseOrder {
  shortest_first,  ///< edges stay of nearly one length
  least_change     ///< of shape: long edges where the surface is flat
};

/// Collapses edges to points that keep the volume (Lindstrom and Turk 1998), down to `triangles`.
/// Whether the result crosses itself is not tested. Nothing where the library cannot handle the
/// mesh.
std::optional<TriangleMesh> collapse_edges(const TriangleMesh& mesh, int triangles,
                                           CollapseOrder order);

}  // namespace fracbench
