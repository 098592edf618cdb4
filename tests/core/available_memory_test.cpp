#include "core/available_memory.h"

#include <gtest/gtest.h>

namespace fracbench {
namespace {

TEST(AvailableMemory, IsLessThanThatOfAnyMachineAndMoreThanThisTestNeeds) {
  EXPECT_GT(available_memory(), std::uint64_t{16} << 20);
  EXPECT_LT(available_memory(), std::uint64_t{1} << 50);
}

}  // namespace
}  // namespace fracbench
