#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace fracbench::neural {

/// Leaves numbers as the memory has them, where std::allocator clears them: the threads that fill a
/// volume are then the first to touch its pages, instead of one thread before them.
template <typename T>
struct UnclearedAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UnclearedAllocator<U>;
  };
  template <typename U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }
};

/// Features [channel][z][y][x]. Volume(n) holds n numbers that are not set.
using Volume = std::vector<float, UnclearedAllocator<float>>;

}  // namespace fracbench::neural
