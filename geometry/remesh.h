#pragma once

#include <stop_token>
#include <string>
#include <string_view>

#include "core/triangle_mesh.h"

namespace fracbench {

struct RemeshOptions {
  int triangles = 1500;  ///< wanted; met within 10 %
  /// Edges whose faces' normals differ by more than this are features: their line is kept where it
  /// is longer than a few edges of the result. Degrees.
  double feature_angle = 45;
  /// Whether the isosurface may stand in where all else fails, and small cavities may close: what
  /// is thin against the triangles may be lost.
  bool allow_isosurface = false;
  /// Give up sooner: the dearest ways are not tried, and no count that would do is looked for.
  bool quick = false;
  int threads = 2;
  std::stop_token stop = {};
};

/// Which way gave the mesh.
enum class RemeshPath {
  isotropic,   ///< remeshed to the wanted size at once
  collapsed,   ///< remeshed finer, then the shortest edges collapsed: where the body is thin
  simplified,  ///< edges collapsed in the order of the change of shape: triangles of many sizes
  isosurface   ///< of the signed distance, then one of the above
};

struct RemeshResult {
  TriangleMesh mesh;  ///< closed, manifold, outward, free of self-intersections
  RemeshPath path = RemeshPath::isotropic;
  double edge_length = 0;    ///< of an equilateral triangle of the mean area, m
  double volume_change = 0;  ///< relative
  double hausdorff = 0;      ///< the farthest of either surface's vertices and face centres, m
};

/// A mesh of nearly equilateral triangles of nearly one size on the surface of the solid `mesh`
/// (several shells are allowed): splits, collapses, flips and tangential relaxation towards one
/// edge length (Botsch and Kobbelt, "A remeshing approach to multiresolution modeling", 2004).
/// Where the body is thin against that length, so that the result crosses itself or loses more
/// than a few percent of the volume, it is remeshed finer and the shortest edges are collapsed to
/// points that keep the volume (Lindstrom and Turk, "Fast and memory efficient polygonal
/// simplification", 1998), shortest first or, as a last resort, in the order of their change of
/// shape.
///
/// `mesh` must be a solid (see require_solid). `name` is the body, for messages. Throws InputError
/// where fewer than 64 triangles are wanted, and where no way gives a solid, naming (unless
/// `quick`) a count that does; Cancelled when asked to stop. The same bytes for any number of
/// threads.
RemeshResult remesh(const TriangleMesh& mesh, std::string_view name,
                    const RemeshOptions& options = {});

}  // namespace fracbench
