#include "methods/bem/refit_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/measures.h"
#include "methods/bem/front_frames.h"
#include "methods/bem/validation/crack_meshes.h"

namespace fracbench::bem {
namespace {

/// Every edge has one face to its left, and the loop of the edges without another face is the
/// sheet's boundary.
void expect_sheet(const CrackSheet& sheet) {
  std::vector<std::int32_t> loop = boundary_loop(sheet.mesh);
  std::vector<std::int32_t> boundary = sheet.boundary;
  ASSERT_EQ(sheet.states.size(), boundary.size());
  std::ranges::rotate(loop, std::ranges::min_element(loop));
  std::ranges::rotate(boundary, std::ranges::min_element(boundary));
  EXPECT_EQ(loop, boundary);
  for (std::size_t f = 0; f < sheet.mesh.faces.size(); ++f) {
    EXPECT_GT(area_vector2(sheet.mesh, f).norm(), 0);
  }
}

TEST(MouthRuns, AreTheLongestPartsAtTheSurface) {
  CrackSheet disc = disc_crack(1, 2);  // 12 vertices on the boundary
  EXPECT_TRUE(mouth_runs(disc).empty());
  for (const int i : {10, 11, 0, 1, 4, 5, 6, 8}) disc.states[i] = FrontState::at_surface;
  const std::vector<MouthRun> runs = mouth_runs(disc);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].first, 4u);
  EXPECT_EQ(runs[0].last, 6u);
  EXPECT_EQ(runs[1].first, 10u);
  EXPECT_EQ(runs[1].last, 1u);
  disc.states.assign(12, FrontState::at_surface);
  ASSERT_EQ(mouth_runs(disc).size(), 1u);
  EXPECT_EQ(mouth_runs(disc)[0].last, 11u);
}

TEST(RefitSheet, EndsAtTheNewMouthAndKeepsTheFront) {
  for (const int rings : {1, 2, 6}) {
    for (const double cut : {0.97, 0.3, -0.2}) {  // a disc that ends at the plane x = cut
      CrackSheet disc = disc_crack(1, rings);
      const std::size_t count = disc.boundary.size();
      int at_surface = 0;
      for (std::size_t i = 0; i < count; ++i) {
        if (disc.mesh.vertices[disc.boundary[i]].x() < cut) continue;
        disc.states[i] = FrontState::at_surface;
        ++at_surface;
      }
      if (at_surface < 3) continue;
      for (Vec3& v : disc.mesh.vertices) v.x() = std::min(v.x(), cut + 0.05);  // flattened there
      std::vector<Vec3> mouth;
      const double half = std::sqrt(1 - cut * cut);
      for (int i = 0; i <= 9; ++i) mouth.emplace_back(cut, half * (2 * i / 9.0 - 1) * 0.97, 0);
      SCOPED_TRACE(rings);
      SCOPED_TRACE(cut);
      const std::vector<MouthRun> runs = mouth_runs(disc);
      ASSERT_EQ(runs.size(), 1u);
      const auto refit = refit_sheet(disc, runs[0], mouth);
      ASSERT_TRUE(refit);
      expect_sheet(refit->sheet);
      EXPECT_EQ(refit->sheet.boundary.size(), count - at_surface + 10);
      for (std::size_t i = 0; i < refit->sheet.boundary.size(); ++i) {
        const Vec3& at = refit->sheet.mesh.vertices[refit->sheet.boundary[i]];
        if (refit->source[i] >= 0) {
          EXPECT_EQ(at, disc.mesh.vertices[disc.boundary[refit->source[i]]]);
          EXPECT_EQ(refit->sheet.states[i], disc.states[refit->source[i]]);
        } else {
          EXPECT_EQ(at.x(), cut);
          EXPECT_EQ(refit->sheet.states[i], FrontState::at_surface);
        }
      }
      for (std::size_t f = 0; f < refit->sheet.mesh.faces.size(); ++f) {
        EXPECT_GT(area_vector2(refit->sheet.mesh, f).z(), 0);
      }
    }
  }
}

TEST(RefitSheet, FindsARingAllAround) {
  CrackSheet disc = disc_crack(1, 5);
  disc.states.assign(disc.states.size(), FrontState::at_surface);
  std::vector<Vec3> ring;
  for (int i = 0; i < 25; ++i) {
    const double angle = 2 * std::numbers::pi * i / 25;
    ring.emplace_back(0.93 * std::cos(angle), 0.93 * std::sin(angle), 0);
  }
  const auto refit = refit_sheet(disc, mouth_runs(disc)[0], ring);
  ASSERT_TRUE(refit);
  expect_sheet(refit->sheet);
  EXPECT_NEAR(area(refit->sheet.mesh), 25.0 / 2 * 0.93 * 0.93 * std::sin(2 * std::numbers::pi / 25),
              1e-9);
}

TEST(RefitSheet, RefusesAMouthThatTheSheetCannotReachWithoutTurningOver) {
  CrackSheet disc = disc_crack(1, 3);
  for (const int i : {0, 1, 2, 3}) disc.states[i] = FrontState::at_surface;
  std::vector<Vec3> mouth;  // against the order of the run
  for (int i = 3; i >= 0; --i) mouth.push_back(disc.mesh.vertices[disc.boundary[i]]);
  EXPECT_FALSE(refit_sheet(disc, mouth_runs(disc)[0], mouth));
}

}  // namespace
}  // namespace fracbench::bem
