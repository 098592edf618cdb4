#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<std::string> actions;  ///< "welded 12 vertices", ...; empty: nothing was done
};

/// Only what cannot change the shape: welds vertices that are bitwise equal (where that does not
/// make an edge non-manifold), drops unused vertices, faces with a repeated vertex and duplicate
/// faces, and turns faces so that neighbours agree and volumes are positive. Everything else is
/// left for check_mesh to report.
RepairedMesh repair_mesh(const TriangleMesh& mesh);

}  // namespace fracbench
