#pragma once

#include "core/triangle_mesh.h"

namespace fracbench::modes {

/// A closed manifold surface with well-shaped triangles of about this edge length, close to `mesh`,
/// which is closed and manifold (CGAL's isotropic remeshing: Botsch and Kobbelt 2004).
TriangleMesh isotropic_remesh(const TriangleMesh& mesh, double edge_length, int iterations = 3);

}  // namespace fracbench::modes
