#include "tests/methods/modes/test_meshes.h"

#include "methods/modes/cage.h"
#include "methods/modes/validation/shapes.h"

namespace fracbench::modes::test {

TetMesh tets_of(const TriangleMesh& shape, int tets) {
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress};
  return tetrahedralise_cage(shape, {.kind = CageKind::shape, .target_tets = tets}, context);
}

TetMesh tets_of_bar(int tets) { return tets_of(plain_bar(), tets); }

}  // namespace fracbench::modes::test
