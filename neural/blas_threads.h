#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>

namespace fracbench::neural {

/// Calls work(i, thread) for every i in [0, count), on up to `threads` threads of OpenMP; `thread`
/// is below `threads`. The calls must not depend on each other, nor throw.
///
/// These are the threads of OpenBLAS's OpenMP build, which computes a product called from here on
/// the calling thread alone: so the result is the same for any number of threads, and what lies
/// between two products runs in parallel as they do. Other threads beside them (core/parallel.h)
/// would wait for a core on which those of OpenMP spin.
template <typename Work>
void on_blas_threads(std::size_t count, int threads, const Work& work) {
  // Two at least where there may be several: OpenBLAS does not take a single one for a team.
  const int used =
      threads <= 1
          ? 1
          : static_cast<int>(std::clamp<std::size_t>(count, 2, static_cast<std::size_t>(threads)));
  const auto end = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for num_threads(used) schedule(dynamic)
  for (std::ptrdiff_t i = 0; i < end; ++i) {
    work(static_cast<std::size_t>(i), static_cast<std::size_t>(omp_get_thread_num()));
  }
}

}  // namespace fracbench::neural
