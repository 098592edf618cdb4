#include "neural/volume.h"

#include <sys/mman.h>

#include <cstdint>

namespace fracbench::neural {

namespace {

constexpr std::size_t kHugePage = 2 << 20;

std::size_t rounded(std::size_t bytes) { return (bytes + kHugePage - 1) / kHugePage * kHugePage; }

}  // namespace

void* map_huge_pages(std::size_t bytes) {
  if (bytes > SIZE_MAX / 2) throw std::bad_array_new_length();
  const std::size_t size = rounded(bytes);
  void* const mapped =
      ::mmap(nullptr, size + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  // Only a block that begins where a huge page can.
  char* const begin = static_cast<char*>(mapped);
  char* const block = begin + rounded(reinterpret_cast<std::uintptr_t>(begin)) -
                      reinterpret_cast<std::uintptr_t>(begin);
  if (block > begin) ::munmap(begin, static_cast<std::size_t>(block - begin));
  if (block < begin + kHugePage) {
    ::munmap(block + size, static_cast<std::size_t>(begin + kHugePage - block));
  }
#ifdef MADV_HUGEPAGE
  ::madvise(block, size, MADV_HUGEPAGE);
#endif
  return block;
}

void unmap_huge_pages(void* block, std::size_t bytes) noexcept { ::munmap(block, rounded(bytes)); }

}  // namespace fracbench::neural
