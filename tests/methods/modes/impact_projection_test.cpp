#include "methods/modes/impact_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/methods/modes/made_up_modes.h"

namespace fracbench {
namespace {

using namespace modes;

constexpr double kDensity = 1000;

Impulse blow(const Vec3& point, const Vec3& momentum) {
  Impulse impulse;
  impulse.point = point;
  impulse.direction = momentum.normalized();
  impulse.magnitude = momentum.norm();
  impulse.normal = -impulse.direction;
  return impulse;
}

struct Projected {
  test::Bar bar = test::bar();
  ModelData data = test::model_data(bar.target, bar.tets, bar.found);
  std::vector<std::int32_t> all = {0, 1, 2, 3};

  Eigen::MatrixX3d velocities(const std::vector<Impulse>& impulses) const {
    return piece_velocities(data.projection, all, impulses, kDensity);
  }
};

TEST(ImpactProjection, KeepsTheMomentum) {
  const Projected made;
  ASSERT_EQ(made.data.projection.piece_count(), 4);
  for (const Vec3& point : {Vec3(-2, 0, 0), Vec3(0.3, 0.5, 0.1), Vec3(2, 0.5, -0.5)}) {
    const Vec3 momentum(3000, -4000, 500);
    const Eigen::MatrixX3d v = made.velocities({blow(point, momentum)});
    // Four pieces of 1 m^3 each.
    const Vec3 sum = kDensity * v.colwise().sum().transpose();
    EXPECT_LT((sum - momentum).norm(), 1e-9 * momentum.norm());
  }
}

TEST(ImpactProjection, IsLinearInTheImpulsesAndTheSameInAllDirections) {
  const Projected made;
  const Vec3 a(-2, 0.1, 0), b(1, 0.5, 0);
  const Vec3 p(100, 20, 0), q(0, -70, 30);
  const Eigen::MatrixX3d both = made.velocities({blow(a, p), blow(b, q)});
  const Eigen::MatrixX3d sum = made.velocities({blow(a, p)}) + made.velocities({blow(b, q)});
  EXPECT_LT((both - sum).norm(), 1e-12 * sum.norm());
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::MatrixX3d turned = made.velocities({blow(a, turn * p)});
  EXPECT_LT((turned - made.velocities({blow(a, p)}) * turn.transpose()).norm(), 1e-12);
}

TEST(ImpactProjection, FallsOffWithTheDistanceFromTheBlow) {
  const Projected made;
  const Eigen::MatrixX3d v = made.velocities({blow(Vec3(-2, 0, 0), Vec3(1000, 0, 0))});
  for (int p = 0; p < 3; ++p) EXPECT_GT(v(p, 0), 2 * v(p + 1, 0));
  EXPECT_GT(v(3, 0), 0);
}

// The bar's longest side is 4: the same bar at half the size and the same density has an eighth of
// the mass, and so eight times the velocities.
TEST(ImpactProjection, ScalesWithTheMass) {
  const Projected made;
  test::Bar small = test::bar();
  for (Vec3& v : small.target.mesh.vertices) v /= 2;
  small.tets.frame.size /= 2;
  small.tets.frame.center /= 2;
  const ModelData data = test::model_data(small.target, small.tets, small.found);
  const auto v = made.velocities({blow(Vec3(-2, 0, 0), Vec3(1000, 0, 0))});
  const std::vector<Impulse> half = {blow(Vec3(-1, 0, 0), Vec3(1000, 0, 0))};
  const auto w = piece_velocities(data.projection, made.all, half, kDensity);
  EXPECT_LT((w - 8 * v).norm(), 1e-3 * w.norm());
  EXPECT_NEAR(data.typical_jump, 8 * made.data.typical_jump, 1e-3 * data.typical_jump);
}

TEST(ImpactProjection, JoinsPiecesBelowTheThresholdAndPartsThemMonotonically) {
  const Projected made;
  const auto v = made.velocities({blow(Vec3(-2, 0, 0), Vec3(1000, 0, 0))});
  EXPECT_EQ(held_together(made.data.projection, made.all, v, 1e9), std::vector<std::int32_t>(4, 0));
  EXPECT_EQ(held_together(made.data.projection, made.all, v, 0), made.all);
  int before = 4;
  for (double threshold = 1e-6; threshold < 10; threshold *= 1.5) {
    const auto groups = held_together(made.data.projection, made.all, v, threshold);
    const int count = 1 + *std::ranges::max_element(groups);
    EXPECT_LE(count, before);
    before = count;
  }
  EXPECT_EQ(before, 1);
  // The end that is hit goes first, along the first cut from it.
  const double parting = parting_jump(made.data.projection, made.all, v);
  EXPECT_EQ(held_together(made.data.projection, made.all, v, 0.999 * parting),
            (std::vector<std::int32_t>{0, 1, 1, 1}));
}

TEST(ImpactProjection, HasABondForEveryPairThatTouches) {
  const Projected made;
  const auto& bonds = made.data.projection.bonds;
  ASSERT_EQ(bonds.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(bonds[k].pieces, (std::array<std::int32_t, 2>{k, k + 1}));
    EXPECT_NEAR(bonds[k].area, 1, 1e-4);
  }
}

TEST(ImpactProjection, OfSomePiecesReachesOnlyTheirVertices) {
  const Projected made;
  const std::vector<std::int32_t> right = {2, 3};
  const std::vector<Impulse> impulses = {blow(Vec3(2, 0, 0), Vec3(1000, 0, 0))};
  const auto v = piece_velocities(made.data.projection, right, impulses, kDensity);
  EXPECT_EQ(v.topRows(2).norm(), 0);
  EXPECT_GT(v(3, 0), v(2, 0));
  EXPECT_GT(v(2, 0), 0);
}

}  // namespace
}  // namespace fracbench
