#include "neural/volume.h"

#include <sys/mman.h>

#include <cstdint>
#include <map>
#include <mutex>
#include <new>

namespace fracbench::neural {

namespace {

constexpr std::size_t kHugePage = 2 << 20;

// Of blocks for the predictions to come: about what one at r = 128 has at a time.
constexpr std::size_t kMostKept = std::size_t{256} << 20;

std::size_t rounded(std::size_t bytes) { return (bytes + kHugePage - 1) / kHugePage * kHugePage; }

/// Blocks that were given back: where a virtual machine makes page faults dear, they take as long
/// as all products of a prediction.
class KeptBlocks {
 public:
  /// Null where there is none of this size.
  void* take(std::size_t size) {
    const std::scoped_lock lock(mutex_);
    const auto found = blocks_.find(size);
    if (found == blocks_.end()) return nullptr;
    void* const block = found->second;
    bytes_ -= size;
    blocks_.erase(found);
    return block;
  }

  /// Whether it is kept: only so many are.
  bool keep(void* block, std::size_t size) noexcept try {
    const std::scoped_lock lock(mutex_);
    if (bytes_ + size > kMostKept) return false;
    blocks_.emplace(size, block);
    bytes_ += size;
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }

 private:
  std::mutex mutex_;
  std::multimap<std::size_t, void*> blocks_;
  std::size_t bytes_ = 0;
};

KeptBlocks& kept_blocks() {
  static auto* const blocks = new KeptBlocks;  // outlives whatever gives blocks back
  return *blocks;
}

}  // namespace

void* map_huge_pages(std::size_t bytes) {
  if (bytes > SIZE_MAX / 2) throw std::bad_array_new_length();
  const std::size_t size = rounded(bytes);
  if (void* const kept = kept_blocks().take(size)) return kept;
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

void unmap_huge_pages(void* block, std::size_t bytes) noexcept {
  const std::size_t size = rounded(bytes);
  if (!kept_blocks().keep(block, size)) ::munmap(block, size);
}

}  // namespace fracbench::neural
