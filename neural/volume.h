#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace fracbench::neural {

/// From here on huge pages are worth their rounding.
inline constexpr std::size_t kLargeBytes = 4 << 20;

/// Memory in huge pages where the system has them: not touched yet, or a block of this size that
/// was given back before, of which 256 MB are kept. Throws std::bad_alloc.
void* map_huge_pages(std::size_t bytes);
void unmap_huge_pages(void* block, std::size_t bytes) noexcept;

/// Leaves numbers as the memory has them, where std::allocator clears them: the threads that fill a
/// volume are then the first to touch its pages, instead of one thread before them. Large volumes
/// are put into huge pages where the system has them: a prediction at r = 128 touches 300 MB for
/// the first time, and by pages of 4 kB that can take as long as all its products.
template <typename T>
struct UnclearedAllocator {
  using value_type = T;

  UnclearedAllocator() = default;
  template <typename U>
  explicit(false) UnclearedAllocator(const UnclearedAllocator<U>&) {}
  bool operator==(const UnclearedAllocator&) const = default;

  T* allocate(std::size_t count) {
    if (!is_large(count)) return std::allocator<T>().allocate(count);
    return static_cast<T*>(map_huge_pages(count * sizeof(T)));
  }
  void deallocate(T* block, std::size_t count) {
    if (!is_large(count)) return std::allocator<T>().deallocate(block, count);
    unmap_huge_pages(block, count * sizeof(T));
  }

  template <typename U>
  void construct(U* at) noexcept {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }

 private:
  static bool is_large(std::size_t count) { return count >= kLargeBytes / sizeof(T); }
};

/// Features [channel][z][y][x]. Volume(n) holds n numbers that are not set.
using Volume = std::vector<float, UnclearedAllocator<float>>;

}  // namespace fracbench::neural
