#pragma once

#include <memory>
#include <vector>

#include "core/target.h"
#include "methods/modes/atomic_pieces.h"
#include "methods/modes/model.h"
#include "tests/methods/modes/tet_blocks.h"

// Modes made by hand, and models of them.
namespace fracbench::test {

/// Scalar modes of unit mass norm whose pieces are those given (per mode, a piece per tet): piece n
/// moves by n.
modes::FractureModes made_up_modes(const modes::TetMesh& tets,
                                   std::vector<std::vector<std::int32_t>> pieces);

/// A bar of 4 x 1 x 1 m along x about the origin, its surface, and a first mode that cuts it in the
/// middle, a second one that cuts it into four equal parts.
struct Bar {
  Target target;
  modes::TetMesh tets;
  modes::FractureModes found;
};
Bar bar();

/// A stage timer and the rest.
struct Surroundings {
  Random random{1};
  StageTimer timer;
  Progress progress;
  Context context(int threads = 1) {
    return {.random = random, .timer = timer, .progress = progress, .threads = threads};
  }
};

/// Everything that a method makes of a body and modes.
modes::ModelData model_data(const Target& target, const modes::TetMesh& tets,
                            const modes::FractureModes& found,
                            const modes::MergeOptions& merge = {});

}  // namespace fracbench::test
