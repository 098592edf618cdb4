#include "metrics/fracture_surface_agreement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/measures.h"
#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

/// The unit cube in two, cut at that height.
Fragments cut_at(double z) {
  const std::vector<Vec3> normals{Vec3::UnitZ()};
  return cut_all(box(), Vec3(0.5, 0.5, z), normals);
}

std::optional<FractureSurfaceAgreement> fracture_surface_agreement(const Fragments& a,
                                                                   const Fragments& b, int samples,
                                                                   Random& random) {
  const SurfaceSamples counts{.fracture_surface = samples, .fragment = 1};
  const SampledFracture of_a(a, counts, random);
  return of_a.surface_agreement(SampledFracture(b, counts, random));
}

std::optional<double> fragment_chamfer(const Fragments& a, const Fragments& b, int samples,
                                       Random& random) {
  const SurfaceSamples counts{.fracture_surface = 1, .fragment = samples};
  const SampledFracture of_a(a, counts, random);
  return of_a.fragment_chamfer(SampledFracture(b, counts, random));
}

TEST(FractureSurfaceAgreement, OfParallelCutsIsTheirDistance) {
  Random random(1);
  const auto agreement = fracture_surface_agreement(cut_at(0.5), cut_at(0.6), 500, random);
  ASSERT_TRUE(agreement);
  EXPECT_NEAR(agreement->chamfer, 0.1, 1e-12);
  EXPECT_NEAR(agreement->hausdorff_95, 0.1, 1e-12);
}

TEST(FractureSurfaceAgreement, OfTheSameCutIsNothing) {
  Random random(1);
  const auto agreement = fracture_surface_agreement(cut_at(0.5), cut_at(0.5), 500, random);
  ASSERT_TRUE(agreement);
  EXPECT_LT(agreement->hausdorff_95, 1e-12);
}

TEST(FractureSurfaceAgreement, OfCrossingCutsIsAQuarterOfTheSide) {
  // From z = 1/2 to x = 1/2 the distance of a point is |x - 1/2|: mean 1/4, 95 % below 0.475.
  Random random(2);
  const std::vector<Vec3> upright{Vec3::UnitX()};
  const auto agreement = fracture_surface_agreement(
      cut_at(0.5), cut_all(box(), Vec3::Constant(0.5), upright), 4000, random);
  ASSERT_TRUE(agreement);
  EXPECT_NEAR(agreement->chamfer, 0.25, 0.01);  // four standard deviations of the mean of the draws
  EXPECT_NEAR(agreement->hausdorff_95, 0.475, 0.01);
}

TEST(FractureSurfaceAgreement, NeedsFractureSurfaceOnBothSides) {
  Random random(1);
  EXPECT_FALSE(fracture_surface_agreement(cut_at(0.5), {whole(box())}, 10, random));
  EXPECT_FALSE(fragment_chamfer(cut_at(0.5), {}, 10, random));
}

TEST(FragmentChamfer, OfTheSameFragmentsIsNothingInAnyOrder) {
  Random random(3);
  Fragments turned = cut_at(0.3);
  std::swap(turned[0], turned[1]);
  EXPECT_LT(fragment_chamfer(cut_at(0.3), turned, 200, random).value(), 1e-12);
}

TEST(FragmentChamfer, GrowsWithTheDistanceOfTheCuts) {
  double last = 0;
  for (const double z : {0.52, 0.6, 0.7, 0.8}) {
    Random random(4);
    const double distance = fragment_chamfer(cut_at(0.5), cut_at(z), 500, random).value();
    EXPECT_GT(distance, last);
    last = distance;
  }
}

TEST(FragmentChamfer, MatchesEachFragmentWithTheNearestOfAll) {
  const std::vector<Vec3> upright{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const std::vector<Vec3> slanted{Vec3(1, 0.2, 0), Vec3(0.1, 1, 0.3), Vec3(-0.2, 0, 1)};
  const Fragments a = cut_all(box(), Vec3(0.5, 0.4, 0.7), upright);
  const Fragments b = cut_all(box(), Vec3(0.6, 0.5, 0.3), slanted);
  Random random(7);
  std::vector<double> of_a(a.size(), 10), of_b(b.size(), 10);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double chamfer = fragment_chamfer({a[i]}, {b[j]}, 2000, random).value();
      of_a[i] = std::min(of_a[i], chamfer);
      of_b[j] = std::min(of_b[j], chamfer);
    }
  }
  double expected = 0;  // the cube has the volume 1
  for (std::size_t i = 0; i < a.size(); ++i) expected += volume(a[i].mesh) * of_a[i] / 2;
  for (std::size_t j = 0; j < b.size(); ++j) expected += volume(b[j].mesh) * of_b[j] / 2;
  const double measured = fragment_chamfer(a, b, 2000, random).value();
  EXPECT_NEAR(measured, expected, 0.02 * expected);  // other points are drawn
}

TEST(FragmentChamfer, IsTheSameBothWaysAndScalesWithTheBody) {
  Random forth(5);
  Random back(6);
  const double a = fragment_chamfer(cut_at(0.5), cut_at(0.7), 4000, forth).value();
  const double b = fragment_chamfer(cut_at(0.7), cut_at(0.5), 4000, back).value();
  EXPECT_NEAR(a, b, 0.05 * a);  // other points are drawn
  Fragments small = cut_at(0.5);
  Fragments other = cut_at(0.7);
  for (Fragments* fragments : {&small, &other}) {
    for (Fragment& fragment : *fragments) {
      for (Vec3& v : fragment.mesh.vertices) v *= 0.01;
    }
  }
  Random again(5);
  EXPECT_NEAR(fragment_chamfer(small, other, 4000, again).value(), 0.01 * a, 1e-9);
}

}  // namespace
}  // namespace fracbench
