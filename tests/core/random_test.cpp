#include "core/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fracbench {
namespace {

TEST(Random, GivesTheSameNumbersForTheSameSeed) {
  Random a(42);
  Random b(42);
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(a.normal(), b.normal());
    EXPECT_EQ(a.below(17), b.below(17));
    EXPECT_EQ(a.unit_vector(), b.unit_vector());
  }
}

TEST(Random, StartsWithTheNumbersThatTheStandardFixesForItsEngine) {
  // ISO C++ [rand.predef]: the 10000th value of a default-seeded mt19937_64.
  Random random(5489);
  for (int k = 0; k < 9999; ++k) random.bits();
  EXPECT_EQ(random.bits(), 9981545732273789042ULL);
}

TEST(Random, UniformHasTheMomentsOfTheUniformDistribution) {
  Random random(1);
  double sum = 0;
  double squares = 0;
  const int n = 200000;
  for (int k = 0; k < n; ++k) {
    const double x = random.uniform();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    sum += x;
    squares += x * x;
  }
  // Five standard errors.
  EXPECT_NEAR(sum / n, 1.0 / 2, 5 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(squares / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / n));
}

TEST(Random, NormalHasMeanZeroVarianceOneAndKurtosisThree) {
  Random random(2);
  double m1 = 0, m2 = 0, m4 = 0;
  const int n = 200000;
  for (int k = 0; k < n; ++k) {
    const double x = random.normal();
    m1 += x;
    m2 += x * x;
    m4 += x * x * x * x;
  }
  EXPECT_NEAR(m1 / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(m2 / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(m4 / n, 3, 5 * std::sqrt(96.0 / n));
}

TEST(Random, BelowHitsEveryValueEquallyOften) {
  Random random(3);
  std::vector<int> counts(7);
  const int n = 70000;
  for (int k = 0; k < n; ++k) ++counts[random.below(7)];
  double chi2 = 0;
  for (const int count : counts) chi2 += (count - 1e4) * (count - 1e4) / 1e4;
  EXPECT_LT(chi2, 30);  // 6 degrees of freedom: exceeded once in 25,000 draws
}

TEST(Random, UnitVectorsHaveLengthOneAndNoPreferredDirection) {
  Random random(4);
  Vec3 mean = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  const int n = 100000;
  for (int k = 0; k < n; ++k) {
    const Vec3 v = random.unit_vector();
    ASSERT_NEAR(v.norm(), 1, 1e-12);
    mean += v / n;
    second += v * v.transpose() / n;
  }
  EXPECT_LT(mean.norm(), 0.02);
  EXPECT_LT((second - Mat3::Identity() / 3).norm(), 0.01);
}

TEST(Random, ForksDependOnTheirNameAndTakeNothingFromTheirParent) {
  Random parent(5);
  Random untouched(5);
  EXPECT_NE(parent.fork("a").bits(), parent.fork("b").bits());
  EXPECT_EQ(parent.fork("a").bits(), untouched.fork("a").bits());
  EXPECT_EQ(parent.bits(), untouched.bits());
}

TEST(DeriveSeed, SeparatesPartsThatReadTheSameWhenJoined) {
  EXPECT_NE(derive_seed(1, {"ab", "c"}), derive_seed(1, {"a", "bc"}));
  EXPECT_NE(derive_seed(1, {"a"}), derive_seed(2, {"a"}));
  EXPECT_NE(derive_seed(1, {"a", "b"}), derive_seed(1, {"b", "a"}));
}

}  // namespace
}  // namespace fracbench
