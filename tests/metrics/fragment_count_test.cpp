#include "metrics/fragment_count.h"

#include <gtest/gtest.h>

#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

TEST(FragmentCount, counts_all_and_those_above_the_minimum) {
  const TriangleMesh body = box(Vec3::Zero(), Vec3(1.9, 1, 1));
  // 50 voxels of 1/64 in 1.9: a slice of the box that has half of that volume is not counted.
  const double minimum = 50.0 / (64.0 * 64 * 64);
  EXPECT_NEAR(smallest_counted_volume(body), minimum, 1e-18);
  for (const double share : {0.5, 2.0}) {
    const auto [small, large] = cut(whole(body), {share * minimum, 0, 0}, {1, 0, 0}, 0);
    const Measurement m = FragmentCount().measure(cell(body, {small, large}));
    EXPECT_EQ(value(m, "fragment_count"), 2);
    EXPECT_EQ(value(m, "fragment_count_above_minimum"), share > 1 ? 2 : 1);
    EXPECT_NEAR(value(m, "minimum_volume_fraction"), minimum / 1.9, 1e-15);
  }
}

TEST(FragmentCount, minimum_follows_the_size_of_the_body) {
  const TriangleMesh small = box();
  const TriangleMesh large = box(Vec3::Constant(-5), Vec3::Constant(5));
  EXPECT_DOUBLE_EQ(smallest_counted_volume(large), 1000 * smallest_counted_volume(small));
}

TEST(FragmentCount, of_a_body_that_did_not_break_is_one) {
  const Measurement m = FragmentCount().measure(cell(box(), {whole(box())}));
  EXPECT_EQ(value(m, "fragment_count"), 1);
  EXPECT_EQ(value(m, "fragment_count_above_minimum"), 1);
}

TEST(FragmentCount, a_fragment_that_is_no_mesh_is_counted_but_not_measured) {
  Fragment broken = whole(box());
  broken.mesh.faces[3][1] = 99;
  const Measurement m = FragmentCount().measure(cell(box(), {whole(box()), broken}));
  EXPECT_EQ(value(m, "fragment_count"), 2);
  EXPECT_EQ(value(m, "fragment_count_above_minimum"), 1);
}

}  // namespace
}  // namespace fracbench
