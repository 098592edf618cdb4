#pragma once

#include "methods/modes/tet_mesh.h"

namespace fracbench::modes::test {

/// The 4 x 1 x 1 bar in its unit box, in about as many tets.
TetMesh tets_of_bar(int tets);

/// Any shape in its unit box, in about as many tets.
TetMesh tets_of(const TriangleMesh& shape, int tets);

}  // namespace fracbench::modes::test
