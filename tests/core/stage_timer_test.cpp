#include "core/stage_timer.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace fracbench {
namespace {

TEST(StageTimer, CountsTimeInNestedStagesOnce) {
  using Clock = std::chrono::steady_clock;
  StageTimer timer;
  const auto begin = Clock::now();
  {
    const auto outer = timer.stage("outer");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    {
      const auto inner = timer.stage("inner");
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const double elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
  ASSERT_EQ(timer.times().size(), 2u);
  EXPECT_EQ(timer.times()[0].name, "outer");
  EXPECT_GE(timer.times()[0].seconds, 0.020);
  EXPECT_GE(timer.times()[1].seconds, 0.020);
  EXPECT_LE(timer.total(), elapsed);
}

TEST(StageTimer, SumsStagesOfOneNameAndKeepsTheOrderOfTheirFirstStart) {
  StageTimer timer;
  for (int round = 0; round < 2; ++round) {
    { const auto a = timer.stage("a"); }
    { const auto b = timer.stage("b"); }
  }
  ASSERT_EQ(timer.times().size(), 2u);
  EXPECT_EQ(timer.times()[0].name, "a");
  EXPECT_EQ(timer.times()[1].name, "b");
}

}  // namespace
}  // namespace fracbench
