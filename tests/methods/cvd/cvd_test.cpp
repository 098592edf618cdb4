#include "methods/cvd/cvd.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.h"
#include "geometry/measures.h"
#include "methods/registry.h"
#include "scenarios/shapes.h"
#include "tests/methods/cvd/bodies.h"
#include "tests/methods/cvd/break_body.h"
#include "tests/methods/cvd/check_pieces.h"

namespace fracbench::test {
namespace {

OptionMap sites(std::int64_t count, double minimum_volume = 1e-4) {
  return {{"sites", count}, {"minimum_volume", minimum_volume}};
}

OptionMap sites_at(std::vector<double> numbers) {
  return {{"sites_at", std::move(numbers)}, {"minimum_volume", 0.0}};
}

const Mat3 kTilt = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();

TEST(Cvd, DividesEveryGeneratedBodyIntoClosedPiecesThatKeepItsSurface) {
  for (const Body& body : generated_bodies()) {
    for (const int count : {1, 2, 7, 40}) {
      for (const std::uint64_t seed : {1u, 2u, 3u}) {
        SCOPED_TRACE(body.name + ", sites " + std::to_string(count));
        expect_partition(body.mesh, break_body(body.mesh, {sites(count), seed}));
      }
    }
  }
}

TEST(Cvd, DividesFiledBodiesIntoClosedPiecesThatKeepTheirSurface) {
  const std::vector<Body> bodies = filed_bodies();
  if (bodies.empty()) GTEST_SKIP() << "../shared/meshes is not there";
  for (const Body& body : bodies) {
    SCOPED_TRACE(body.name);
    expect_partition(body.mesh, break_body(body.mesh, {sites(30), 5}));
  }
}

TEST(Cvd, DividesEveryGeneratedShapeIntoClosedPiecesThatKeepItsSurface) {
  for (const ShapeInfo& shape : list_shapes()) {
    if (shape.source != "generated") continue;
    SCOPED_TRACE(shape.name);
    const TriangleMesh mesh = load_shape({.name = shape.name}).mesh;
    expect_partition(mesh, break_body(mesh, {sites(25), 7}));
  }
}

TEST(Cvd, DividesBodiesWhoseVerticesLieOnTheBisectors) {
  // Sites in mirror pairs: the cells' faces pass through vertices, along edges and along faces.
  const std::vector<double> octants{-0.5, -0.5, -0.5, 0.5,  -0.5, -0.5, -0.5, 0.5,
                                    -0.5, 0.5,  0.5,  -0.5, -0.5, -0.5, 0.5,  0.5,
                                    -0.5, 0.5,  -0.5, 0.5,  0.5,  0.5,  0.5,  0.5};
  for (const Body& body : generated_bodies()) {
    SCOPED_TRACE(body.name);
    expect_partition(body.mesh, break_body(body.mesh, {sites_at(octants)}));
    expect_partition(body.mesh, break_body(body.mesh, {sites_at({-0.5, 0, 0, 0.5, 0, 0})}));
    expect_partition(body.mesh, break_body(body.mesh, {sites_at({0, 0, 0, 1.9 - 1.9 / 7, 0, 0})}));
  }
}

TEST(Cvd, DividesTurnedBodiesWhoseVerticesLieOnTheBisectorsButForRounding) {
  // A grid of sites: eight cells meet at each corner, up to rounding.
  std::vector<double> grid;
  for (const double x : {-0.5, 0.0, 0.5}) {
    for (const double y : {-0.5, 0.0, 0.5}) {
      for (const double z : {-0.5, 0.0, 0.5}) {
        const Vec3 p = kTilt * Vec3(x, y, z);
        grid.insert(grid.end(), {p[0], p[1], p[2]});
      }
    }
  }
  for (const Body& body : generated_bodies()) {
    SCOPED_TRACE(body.name);
    const TriangleMesh turned = rotated(body.mesh, kTilt);
    expect_partition(turned, break_body(turned, {sites_at(grid)}));
  }
}

TEST(Cvd, LeavesNoCrossingFacesWhereItMustMakeEdgesNearTheRoundingOfCoordinates) {
  const std::vector<Vec3> corners{{-.5, -.5, -.5}, {-.5, -.5, .5}, {-.5, .5, -.5}, {-.5, .5, .5},
                                  {.5, -.5, -.5},  {.5, -.5, .5},  {.5, .5, -.5},  {.5, .5, .5}};
  for (const std::uint64_t seed : {1u, 2u, 4u}) {
    Random random(seed);
    const double angle = random.uniform(0, 6.28);
    const Mat3 turn = Eigen::AngleAxisd(angle, random.unit_vector()).toRotationMatrix();
    std::vector<double> octants;
    for (const Vec3& corner : corners) {
      const Vec3 p = turn * corner;
      octants.insert(octants.end(), {p[0], p[1], p[2]});
    }
    for (const Body& body : generated_bodies()) {
      SCOPED_TRACE(body.name + ", seed " + std::to_string(seed));
      const TriangleMesh turned = rotated(body.mesh, turn);
      EXPECT_EQ(count_crossings(break_body(turned, {sites_at(octants)})), 0u);
    }
  }
}

TEST(Cvd, CutsACubeIntoHalvesAndOctantsOfExactVolume) {
  // Sides with an odd number of divisions have no vertex on the cut.
  const auto halves = sorted_volumes(break_body(cube(3), {sites_at({-0.5, 0, 0, 0.5, 0, 0})}));
  ASSERT_EQ(halves.size(), 2u);
  for (const double volume : halves) EXPECT_NEAR(volume, 4, 1e-14);

  for (const int n : {3, 4}) {
    const auto octants = sorted_volumes(
        break_body(cube(n), {sites_at({-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                       -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1})}));
    ASSERT_EQ(octants.size(), 8u);
    for (const double volume : octants) EXPECT_NEAR(volume, 1, 1e-7);
  }
}

TEST(Cvd, GivesTheSameVolumesForABodyThatIsTurned) {
  const std::vector<Vec3> points{
      {0.3, 0.2, 0.1}, {-0.4, 0.1, 0.5}, {0.1, -0.6, -0.2}, {-0.3, 0.4, -0.5}, {0.6, 0.5, 0.4}};
  for (const Body& body : generated_bodies()) {
    SCOPED_TRACE(body.name);
    std::vector<double> here, there;
    for (const Vec3& p : points) {
      const Vec3 q = kTilt * p;
      here.insert(here.end(), {p[0], p[1], p[2]});
      there.insert(there.end(), {q[0], q[1], q[2]});
    }
    const auto volumes = sorted_volumes(break_body(body.mesh, {sites_at(here)}));
    const auto turned = sorted_volumes(break_body(rotated(body.mesh, kTilt), {sites_at(there)}));
    ASSERT_EQ(volumes.size(), turned.size());
    for (std::size_t p = 0; p < volumes.size(); ++p) EXPECT_NEAR(volumes[p], turned[p], 1e-12);
  }
}

TEST(Cvd, GivesTheSameBytesForAnyNumberOfThreadsAndOthersForAnotherSeed) {
  const TriangleMesh body = generated_bodies().back().mesh;
  const std::string one = digest(break_body(body, {sites(40), 11, 1}));
  EXPECT_EQ(one, digest(break_body(body, {sites(40), 11, 2})));
  EXPECT_EQ(one, digest(break_body(body, {sites(40), 11, 3})));
  EXPECT_NE(one, digest(break_body(body, {sites(40), 12, 1})));
}

TEST(Cvd, MakesMorePiecesOfMoreSites) {
  std::size_t last = 0;
  for (const int count : {1, 3, 10, 30, 100}) {
    const std::size_t pieces = break_body(sphere(3), {sites(count)}).size();
    EXPECT_EQ(pieces, static_cast<std::size_t>(count));  // cells of a convex body are connected
    EXPECT_GT(pieces, last);
    last = pieces;
  }
}

TEST(Cvd, MakesSmallerPiecesNearTheImpact) {
  const TriangleMesh body = cube(4);
  const auto mean_distance = [&](double falloff) {
    OptionMap options = sites(50);
    options["falloff"] = falloff;
    double sum = 0;
    const auto pieces = break_body(body, {options});
    for (const Piece& piece : pieces) {
      sum += (mass_properties(piece.mesh).center - body.vertices[0]).norm();
    }
    return sum / static_cast<double>(pieces.size());
  };
  EXPECT_LT(mean_distance(0.2), 0.8 * mean_distance(1));
  EXPECT_LT(mean_distance(1), 0.95 * mean_distance(0));
}

TEST(Cvd, SplitsACellIntoItsConnectedParts) {
  // A fork with three prongs, cut across: the foot stays whole, the prongs come apart.
  const TriangleMesh fork = boxes(5, 1, 6, [](int i, int, int k) { return k < 2 || i % 2 == 0; });
  const auto pieces = break_body(fork, {sites_at({0.013, 0, -0.6, 0.011, 0, 0.9})});
  EXPECT_EQ(pieces.size(), 4u);
  expect_partition(fork, pieces);
}

TEST(Cvd, BreaksBodiesThatTouchAlongAnEdge) {
  // Two cubes with vertices of their own at the same places, those of the second in either order.
  for (const bool reversed : {false, true}) {
    TriangleMesh body = cube(1);
    const TriangleMesh one = body;
    const auto count = static_cast<std::int32_t>(one.vertices.size());
    for (std::int32_t v = 0; v < count; ++v) {
      body.vertices.push_back(one.vertices[reversed ? count - 1 - v : v] + Vec3(2, 2, 0));
    }
    for (Face face : one.faces) {
      for (std::int32_t& v : face) v = count + (reversed ? count - 1 - v : v);
      body.faces.push_back(face);
    }
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
      const Mat3 turn =
          seed == 1 ? Mat3::Identity()
                    : Eigen::AngleAxisd(0.7 * static_cast<double>(seed), Vec3(1, 2, 3).normalized())
                          .toRotationMatrix();
      const TriangleMesh turned = rotated(body, turn);
      const auto pieces = break_body(turned, {sites(12, 0), seed});
      EXPECT_GT(pieces.size(), 12u);
      expect_partition(turned, pieces);
    }
  }
}

TEST(Cvd, KeepsACavityWithThePieceAroundIt) {
  const TriangleMesh hollow =
      boxes(9, 9, 9, [](int i, int j, int k) { return !(i == 2 && j == 2 && k == 2); });
  const auto pieces = break_body(hollow, {sites_at({-0.5, 0.01, 0.02, 0.7, 0.03, 0.04})});
  EXPECT_EQ(pieces.size(), 2u);
  expect_partition(hollow, pieces);
}

TEST(Cvd, MergesPiecesBelowTheMinimumVolumeAndLeavesNoFaceBetweenThem) {
  for (const Body& body : generated_bodies()) {
    SCOPED_TRACE(body.name);
    const double minimum = 0.03;
    const auto pieces = break_body(body.mesh, {sites(40, minimum), 3});
    expect_partition(body.mesh, pieces);
    const auto all = break_body(body.mesh, {sites(40, 0), 3});
    EXPECT_LT(pieces.size(), all.size());
    for (const Piece& piece : pieces) {
      const bool alone =
          std::ranges::none_of(piece.faces, [](const PieceFace& f) { return f.is_fracture(); });
      EXPECT_TRUE(alone || volume(piece.mesh) >= minimum * volume(body.mesh));
    }
  }
}

TEST(Cvd, GivesTheSamePiecesAfterSavingAndLoading) {
  const Method& cvd = find_method("cvd");
  const Options options(cvd.options(), sites(10), "test");
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  const Target target{"cube", cube(3), {}};
  const auto loaded = cvd.load("", target, options);
  EXPECT_EQ(digest(loaded->fracture(push_at(target.mesh.vertices[0]), context)),
            digest(break_body(target.mesh, {sites(10), 1})));
}

TEST(Cvd, TimesItsStagesByName) {
  const Method& cvd = find_method("cvd");
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  cvd.prepare({"cube", cube(3), {}}, {}, Options(cvd.options(), {}, "test"), context)
      ->fracture({}, context);
  std::vector<std::string> names;
  for (const StageTime& time : timer.times()) names.push_back(time.name);
  EXPECT_EQ(names, (std::vector<std::string>{"sites", "cells", "cut", "components", "merge"}));
}

TEST(Cvd, RefusesSitesThatCannotBeMet) {
  EXPECT_THROW(break_body(cube(2), {sites_at({0, 0})}), InputError);
  EXPECT_THROW(break_body(cube(2), {sites_at({0, 0, 0, 1, 1, 1, 0, 0, 0})}), InputError);
  EXPECT_THROW(break_body(cube(2), {sites_at({0, 0, 1e6})}), InputError);
}

TEST(Cvd, RefusesBodiesThatAreOpenOrTurnedInwards) {
  TriangleMesh open = cube(2);
  open.faces.pop_back();
  EXPECT_THROW(break_body(open, {sites(3)}), MethodFailure);
  TriangleMesh inverted = cube(2);
  for (Face& face : inverted.faces) std::swap(face[0], face[1]);
  EXPECT_THROW(break_body(inverted, {sites(3)}), MethodFailure);
}

}  // namespace
}  // namespace fracbench::test
