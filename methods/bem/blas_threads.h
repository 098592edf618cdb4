#pragma once

#include <cblas.h>

namespace fracbench::bem {

/// Below this many unknowns one thread factorises in a few tenths of a second, and several mostly
/// wait for each other where the processor is shared.
inline constexpr long kThreadedUnknowns = 3000;

/// Sets the threads of BLAS and LAPACK for work on a matrix of this many unknowns. The setting is
/// the process's, so that it is made before every such piece of work.
inline void set_blas_threads(long unknowns, int threads) {
  openblas_set_num_threads(unknowns < kThreadedUnknowns ? 1 : threads);
}

}  // namespace fracbench::bem
