#include "core/freed_memory.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "core/process_tree.h"

namespace fracbench {
namespace {

constexpr std::size_t kBytes = 20 << 20;

void take_and_free() {
  void* block = std::malloc(kBytes);
  std::memset(block, 1, kBytes);
  asm volatile("" : : "r"(block) : "memory");  // so that it is not left out
  std::free(block);
}

/// Whether a block that is freed stays in memory; in a process of its own, since this is for ever.
bool keeps(bool asked_to) {
  const ::pid_t child = ::fork();
  if (child == 0) {
    if (asked_to) keep_freed_memory();
    const std::uint64_t before = resident_memory(::getpid());
    take_and_free();
    ::_exit(resident_memory(::getpid()) >= before + kBytes / 2 ? 1 : 0);
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  return WEXITSTATUS(status) == 1;
}

TEST(FreedMemory, IsKeptWhereThatIsAskedFor) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "another allocator";
#endif
  EXPECT_TRUE(keeps(true));
  EXPECT_FALSE(keeps(false)) << "then there is no need to ask";
}

}  // namespace
}  // namespace fracbench
