#include <gtest/gtest.h>

#include "core/stage_timer.h"
#include "metrics/peak_memory.h"
#include "metrics/stage_times.h"
#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

Measurement times(std::vector<StageTime> stages, double total) {
  const TriangleMesh body = box();
  const Fragments fragments;
  return StageTimes().measure({.body = body,
                               .fragments = fragments,
                               .impacts = {},
                               .stages = stages,
                               .total_seconds = total});
}

TEST(StageTimes, give_each_stage_the_total_and_the_share_that_is_accounted_for) {
  const Measurement m = times({{"cells", 0.5}, {"cut", 1.25}}, 1.76);
  EXPECT_EQ(value(m, "stage_cells"), 0.5);
  EXPECT_EQ(value(m, "stage_cut"), 1.25);
  EXPECT_EQ(value(m, "total_seconds"), 1.76);
  EXPECT_DOUBLE_EQ(value(m, "stage_coverage"), 1.75 / 1.76);
}

TEST(StageTimes, must_add_up_within_two_percent) {
  EXPECT_TRUE(stages_add_up(times({{"a", 1}, {"b", 0.99}}, 2)));
  EXPECT_FALSE(stages_add_up(times({{"a", 1}, {"b", 0.95}}, 2)));  // time that nobody owns
  EXPECT_FALSE(stages_add_up(times({{"a", 1}, {"b", 1.05}}, 2)));  // time counted twice
  EXPECT_FALSE(stages_add_up(times({}, 2)));
  EXPECT_FALSE(stages_add_up(times({}, 0)));
}

TEST(StageTimes, of_nested_stages_of_the_timer_add_up) {
  StageTimer timer;
  const auto busy = [] {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(10);
    while (std::chrono::steady_clock::now() < until) {
    }
  };
  const auto start = std::chrono::steady_clock::now();
  {
    const auto outer = timer.stage("outer");
    busy();
    const auto inner = timer.stage("inner");
    busy();
  }
  const std::chrono::duration<double> total = std::chrono::steady_clock::now() - start;
  EXPECT_TRUE(stages_add_up(times(timer.times(), total.count())));
}

TEST(PeakMemory, is_given_in_bytes_or_not_at_all) {
  const TriangleMesh body = box();
  const Fragments fragments;
  CellResult result = cell(body, fragments);
  EXPECT_FALSE(has(PeakMemory().measure(result), "peak_memory"));
  result.peak_memory = 123456789;
  EXPECT_EQ(value(PeakMemory().measure(result), "peak_memory"), 123456789);
}

}  // namespace
}  // namespace fracbench
