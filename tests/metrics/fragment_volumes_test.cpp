#include "metrics/fragment_volumes.h"

#include <gtest/gtest.h>

#include <limits>

#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

TEST(FragmentVolumes, are_in_the_order_of_the_fragments_and_add_up_to_ten) {
  const TriangleMesh body = box({1, 2, 3}, {3, 4, 5});
  const auto [left, right] = cut(whole(body), {1.6, 0, 0}, {1, 0, 0}, 0);
  const auto [near, far] = cut(right, {0, 3, 0}, {0, 1, 0}, 1);
  const Measurement m = FragmentVolumes().measure(cell(body, {left, near, far}));
  const std::vector<double>& volumes = series(m, "fragment_volume");
  ASSERT_EQ(volumes.size(), 3u);
  EXPECT_NEAR(volumes[0], 3, 1e-13);
  EXPECT_NEAR(volumes[1], 3.5, 1e-13);
  EXPECT_NEAR(volumes[2], 3.5, 1e-13);
  EXPECT_NEAR(value(m, "fragment_volume_mean"), 10.0 / 3, 1e-13);
  EXPECT_NEAR(value(m, "fragment_volume_median"), 3.5, 1e-13);
  EXPECT_NEAR(value(m, "fragment_volume_deviation"), std::sqrt(1.0 / 12), 1e-13);
  EXPECT_NEAR(value(m, "fragment_volume_largest"), 3.5, 1e-13);
  EXPECT_NEAR(value(m, "fragment_volume_smallest"), 3, 1e-13);
}

TEST(FragmentVolumes, of_a_fragment_turned_inside_out_is_negative) {
  Fragment flipped = whole(box());
  for (Face& face : flipped.mesh.faces) std::swap(face[0], face[1]);
  const Measurement m = FragmentVolumes().measure(cell(box(), {flipped}));
  EXPECT_NEAR(series(m, "fragment_volume").at(0), -10, 1e-13);
}

TEST(FragmentVolumes, leave_out_what_does_not_exist) {
  const Measurement one = FragmentVolumes().measure(cell(box(), {whole(box())}));
  EXPECT_FALSE(has(one, "fragment_volume_deviation"));
  EXPECT_TRUE(FragmentVolumes().measure(cell(box(), {})).values.empty());
  Fragment broken = whole(box());
  broken.mesh.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  const Measurement m = FragmentVolumes().measure(cell(box(), {broken, whole(box())}));
  EXPECT_EQ(series(m, "fragment_volume").size(), 1u);
}

}  // namespace
}  // namespace fracbench
