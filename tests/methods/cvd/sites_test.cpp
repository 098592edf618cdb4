#include "methods/cvd/sites.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/error.h"
#include "geometry/measures.h"
#include "methods/cvd/interior_samples.h"
#include "methods/cvd/winding.h"
#include "tests/methods/cvd/bodies.h"

namespace fracbench::cvd {
namespace {

TEST(InteriorSamples, LieInsideEveryBodyAndShowItsVolumeAndCentre) {
  for (const auto& [name, mesh] : test::generated_bodies()) {
    SCOPED_TRACE(name);
    const std::size_t count = 20000;
    const std::vector<Vec3> points = interior_samples(surface_topology(mesh), count, 1);
    EXPECT_NEAR(static_cast<double>(points.size()) / count, 1, 0.1);
    Vec3 center = Vec3::Zero();
    for (const Vec3& point : points) center += point / static_cast<double>(points.size());
    EXPECT_LT((center - mass_properties(mesh).center).norm(), 0.02);
    for (std::size_t p = 0; p < points.size(); p += 97) {
      EXPECT_NEAR(winding_number(mesh, points[p]), 1, 1e-6);
    }
  }
}

TEST(InteriorSamples, AreFoundInAShellMuchThinnerThanTheirSpacing) {
  TriangleMesh plate = test::cube(3);
  for (Vec3& v : plate.vertices) v[0] *= 1e-4;
  EXPECT_GE(interior_samples(surface_topology(plate), 1000, 100).size(), 100u);
}

TEST(InteriorSamples, OfAnObliqueShellAsThinAsRoundingAllowsTakeNoMoreMemoryThanOthers) {
  TriangleMesh plate = test::cube(3);
  for (Vec3& v : plate.vertices) {
    v[0] *= 1e-12;
    v = Vec3(v[0] + v[1] + v[2], v[1] - v[0], v[2] - v[0]) / 2;
  }
  const auto points = interior_samples(surface_topology(plate), 20000, 20);
  EXPECT_NEAR(static_cast<double>(points.size()), 20000, 2000);
}

TEST(Lloyd, NeverRaisesTheEnergy) {
  for (const auto& [name, mesh] : test::generated_bodies()) {
    SCOPED_TRACE(name);
    const auto points = interior_samples(surface_topology(mesh), 5000, 1);
    Random random(4);
    const WeightedSamples samples = density(points, mesh.vertices[0], 0.5);
    const Relaxation relaxation = lloyd(samples, draw_sites(samples, 20, random), 15, 2);
    ASSERT_EQ(relaxation.energy.size(), 16u);
    for (std::size_t n = 1; n < relaxation.energy.size(); ++n) {
      EXPECT_LE(relaxation.energy[n], relaxation.energy[n - 1] * (1 + 1e-14));
    }
    EXPECT_LT(relaxation.energy.back(), 0.9 * relaxation.energy.front());
  }
}

TEST(Lloyd, AssignsEachSampleToItsNearestSite) {
  // One iteration against the definition.
  const auto points = interior_samples(surface_topology(test::sphere(2)), 2000, 1);
  Random random(5);
  const WeightedSamples samples = density(points, Vec3(1, 0, 0), 0.3);
  const std::vector<Vec3> sites = draw_sites(samples, 17, random);
  std::vector<Vec3> sums(sites.size(), Vec3::Zero());
  std::vector<double> weights(sites.size(), 0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    std::size_t best = 0;
    for (std::size_t s = 1; s < sites.size(); ++s) {
      if ((sites[s] - points[p]).squaredNorm() < (sites[best] - points[p]).squaredNorm()) best = s;
    }
    sums[best] += samples.weights[p] * points[p];
    weights[best] += samples.weights[p];
  }
  const std::vector<Vec3> moved = lloyd(samples, sites, 1, 1).sites;
  for (std::size_t s = 0; s < sites.size(); ++s) {
    EXPECT_LT((moved[s] - sums[s] / weights[s]).norm(), 1e-14);
  }
}

TEST(Lloyd, PutsOneSiteAtTheCentreOfMass) {
  const TriangleMesh mesh = test::generated_bodies()[2].mesh;  // concave
  const auto points = interior_samples(surface_topology(mesh), 50000, 1);
  Random random(6);
  const WeightedSamples samples = density(points, Vec3::Zero(), 0);
  const auto sites = lloyd(samples, draw_sites(samples, 1, random), 1, 1).sites;
  EXPECT_LT((sites[0] - mass_properties(mesh).center).norm(), 0.005);
}

TEST(DrawSites, GivesDifferentSamplesDenserWhereTheWeightIsLarger) {
  std::vector<Vec3> points;
  for (int n = 0; n < 10000; ++n) points.emplace_back(n / 10000.0, 0, 0);
  const WeightedSamples samples = density(points, Vec3::Zero(), 0.25);
  Random random(7);
  const std::vector<Vec3> sites = draw_sites(samples, 500, random);
  std::set<double> seen;
  double mean = 0;
  for (const Vec3& site : sites) {
    seen.insert(site[0]);
    mean += site[0] / 500;
  }
  EXPECT_EQ(seen.size(), 500u);
  // Mean of the density exp(-x / l) on [0, 1].
  const double l = 0.25, end = std::exp(-1 / l);
  EXPECT_NEAR(mean, l - end / (1 - end), 0.03);
}

}  // namespace
}  // namespace fracbench::cvd
