#include "geometry/segmentation/flood_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <queue>
#include <tuple>

#include "core/random.h"

namespace fracbench {
namespace {

/// Pushes and pops by chance on both queues; `draw` gives the next value from the last one popped.
template <typename Draw>
void expect_same_order(std::uint64_t seed, std::size_t expected_entries, const Draw& draw,
                       float low = 0) {
  using Item = std::tuple<float, std::uint32_t>;  // items are numbered as they are pushed
  std::priority_queue<Item, std::vector<Item>, std::greater<>> plain;
  FloodQueue queue(low, 128, expected_entries);
  Random random(seed);
  float last = 0;
  std::uint32_t items = 0;
  for (int step = 0; step < 60000; ++step) {
    if (step < 40000 && random.uniform() < 0.6) {
      const float value = draw(random, last);
      plain.emplace(value, items);
      queue.push({value, items++});
      continue;
    }
    FloodQueue::Entry entry{};
    ASSERT_EQ(queue.pop(entry), !plain.empty());
    if (plain.empty()) continue;
    ASSERT_EQ(entry.item, std::get<1>(plain.top())) << "step " << step << ", seed " << seed;
    ASSERT_EQ(entry.value, std::get<0>(plain.top()));
    plain.pop();
    last = entry.value;
  }
}

TEST(FloodQueue, PopsInTheOrderOfAPlainHeap) {
  for (const std::size_t entries : {1u, 3000u, 1000000u}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      expect_same_order(seed, entries, [](Random& random, float last) {  // growing, as in a flood
        return std::min(128.0f, last + static_cast<float>(random.uniform(0, 0.5)));
      });
      expect_same_order(seed, entries, [](Random& random, float last) {  // plateaus
        return std::min(128.0f, std::floor(last + static_cast<float>(random.uniform(0, 1.2))));
      });
      expect_same_order(seed, entries, [](Random& random, float last) {  // with steps back
        return last + std::round(static_cast<float>(random.uniform(-3, 3.1)) * 4) / 4;
      });
      for (const float low : {0.0f, 100.0f, 128.0f}) {  // without any order
        expect_same_order(
            seed, entries,
            [](Random& random, float) { return static_cast<float>(random.uniform(-200, 400)); },
            low);
      }
    }
  }
}

}  // namespace
}  // namespace fracbench
