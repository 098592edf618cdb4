#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <thread>

namespace fracbench {

/// Of this machine.
inline int hardware_threads() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Calls work(i) for every i in [0, count), on up to `threads` threads. The calls must not depend
/// on each other: then the result is the same for any number of threads.
template <typename Work>
void parallel_for(std::size_t count, int threads, const Work& work, std::size_t grain = 1) {
  if (threads <= 1 || count <= grain) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i) work(i);
    });
  });
}

}  // namespace fracbench
