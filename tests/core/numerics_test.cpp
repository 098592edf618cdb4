#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "core/parallel.h"
#include "core/sum.h"
#include "core/text.h"

namespace fracbench {
namespace {

TEST(Sum, KeepsSmallTermsBesideLargeOnes) {
  Sum sum;
  double naive = 0;
  for (const double term : {1.0, 1e100, 1.0, -1e100}) {
    sum += term;
    naive += term;
  }
  EXPECT_EQ(sum.value(), 2.0);
  EXPECT_EQ(naive, 0.0);  // what an ordinary sum makes of it
}

TEST(ParallelFor, CallsEveryIndexOnceForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3}) {
    std::vector<std::atomic<int>> calls(1000);
    parallel_for(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) ASSERT_EQ(count, 1);
  }
}

TEST(ParallelFor, PassesOnWhatTheWorkThrows) {
  EXPECT_THROW(parallel_for(100, 2,
                            [](std::size_t i) {
                              if (i == 57) throw std::runtime_error("57");
                            }),
               std::runtime_error);
}

TEST(Nearest, FindsTheWordThatWasMeant) {
  const std::vector<std::string> known = {"methods", "metrics", "scenarios"};
  EXPECT_EQ(nearest("metods", known), "methods");
  EXPECT_EQ(nearest("scenaroi", known), "scenarios");
  EXPECT_EQ(nearest("bunny", known), std::nullopt);
}

}  // namespace
}  // namespace fracbench
