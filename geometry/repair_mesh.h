#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<std::string> actions;  ///< "welded 12 vertices", ...; empty: nothing was done
};

/// Only what cannot change the shape: welds vertices on open edges that are equal (but not where
/// more than two faces would then share an edge), drops unused vertices, faces with a repeated
/// vertex and duplicate faces, and turns faces so that neighbours agree and volumes are positive
/// (negative around cavities). Everything else is left for check_mesh to report; so is a mesh with
/// an index out of range, which comes back as it is. A solid comes back bit for bit, but for
/// vertices that it does not use.
RepairedMesh repair_mesh(const TriangleMesh& mesh);

}  // namespace fracbench
