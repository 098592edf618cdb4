#include "methods/bem/propagate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/methods/bem/growth_setup.h"

namespace fracbench::bem {
namespace {

using test::Start;

TEST(Propagation, CutsABarUnderTensionInTwoWhereTheCrackStarts) {
  const double x = 0.1;
  CutLinks links(test::box({1.9, 0.5, 0.4}), 0.02, 1);
  const auto model =
      test::model(test::uniaxial(Vec3(1, 0, 0), 1e7), {Start{{x, 0.25, 0.03}, {0, 1, 0}}});
  const Propagation result = test::run(links, model, test::long_run(0.1));
  EXPECT_EQ(result.report.end, PropagationEnd::complete);
  EXPECT_EQ(result.report.new_cracks, 1u);
  EXPECT_TRUE(result.report.failures.empty());
  ASSERT_EQ(result.cracks.size(), 1u);
  for (const Vec3& v : result.cracks[0].surface.vertices) EXPECT_NEAR(v.x(), x, 1e-9);
  EXPECT_NEAR(result.report.area, 0.5 * 0.4, 0.05 * 0.5 * 0.4);
  const std::vector<double> parts = test::parts(links);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0], (0.95 + x) / 1.9, 0.02 / 1.9);
}

}  // namespace
}  // namespace fracbench::bem
