#include "methods/bem/crack_system.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/progress.h"
#include "geometry/measures.h"
#include "methods/bem/conform_cracks.h"
#include "methods/bem/elastic_operator.h"
#include "methods/bem/full_model.h"
#include "methods/bem/rigid_parts.h"
#include "methods/bem/validation/crack_meshes.h"

namespace fracbench::bem {
namespace {

struct Surroundings {
  Random random{1};
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress, .threads = 2};
};

const Material kGlass{.young_modulus = 7e10, .poisson_ratio = 0.3};

std::vector<double> even(double low, double high, int count) {
  std::vector<double> points{low};
  for (const double x : graded(low, high, count, 1)) points.push_back(x);
  return points;
}

TriangleMesh cube(int steps) {
  const std::vector<double> grid = even(-1, 1, steps);
  return grid_box(grid, grid, grid);
}

/// A disc in the plane z = height, its boundary `at_surface` where `reaches` says so.
CrackSheet flat_disc(double radius, int rings, double height, auto reaches) {
  CrackSheet disc = disc_crack(radius, rings);
  for (Vec3& v : disc.mesh.vertices) v.z() = height;
  for (std::size_t i = 0; i < disc.boundary.size(); ++i) {
    if (reaches(disc.mesh.vertices[disc.boundary[i]])) disc.states[i] = FrontState::at_surface;
  }
  return disc;
}

/// Its middle near the side x = 1 of the cube, what lies beyond squeezed to just outside.
void move_to_side(CrackSheet& disc) {
  for (Vec3& v : disc.mesh.vertices) {
    const double x = v.x() + 0.9;
    v.x() = x > 1 ? 1 + 0.12 * (x - 1) : x;
  }
}

/// Uniform stress along z.
StressField pull_along_z(double stress) {
  return [stress](std::span<const Vec3> points) {
    return std::vector<Mat3>(points.size(), stress * Vec3::UnitZ() * Vec3::UnitZ().transpose());
  };
}

FullModel pulled_model(const TriangleMesh& body, Context& context) {
  const Mat3 stress = 1e6 * Vec3::UnitZ() * Vec3::UnitZ().transpose();
  return FullModel(body, pull_along_z(1e6), std::vector<Mat3>(body.faces.size(), stress), kGlass,
                   context);
}

TEST(OperatorCache, GivesTheOperatorThatWholeAssemblyGives) {
  Surroundings around;
  TriangleMesh mesh = cube(3);
  OperatorCache cache(kGlass);
  cache.update(make_boundary_elements(mesh), around.context);
  EXPECT_EQ(cache.assembled_vertices(), mesh.vertices.size());
  cache.update(make_boundary_elements(mesh), around.context);
  EXPECT_EQ(cache.assembled_vertices(), 0u);

  mesh.vertices[5] += Vec3(0.05, -0.03, 0.02);
  std::swap(mesh.vertices[0], mesh.vertices[9]);  // another numbering
  for (Face& face : mesh.faces) {
    for (std::int32_t& v : face) v = v == 0 ? 9 : v == 9 ? 0 : v;
  }
  const BoundaryElements elements = make_boundary_elements(mesh);
  const Eigen::MatrixXd& updated = cache.update(elements, around.context);
  EXPECT_GT(cache.assembled_vertices(), 0u);
  EXPECT_LT(cache.assembled_vertices(), 12u);
  const Eigen::MatrixXd whole = assemble_hypersingular(elements, kGlass, around.context);
  EXPECT_LT((updated - whole).norm(), 1e-4 * whole.norm());
  EXPECT_EQ((updated - updated.transpose()).norm(), 0);
}

TEST(OpeningsInInfiniteBody, FollowTheLoadAndTheFrame) {
  Surroundings around;
  const std::vector<CrackSheet> cracks{disc_crack(0.2, 3)};
  Mat3 stress = Mat3::Zero();
  stress(2, 2) = 1e6;
  const auto pulled = openings_in_infinite_body(cracks, stress, kGlass, around.context);
  const auto pressed = openings_in_infinite_body(cracks, -2 * stress, kGlass, around.context);
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<CrackSheet> turned = cracks;
  for (Vec3& v : turned[0].mesh.vertices) v = turn * v + Vec3(3, 1, 2);
  const auto again =
      openings_in_infinite_body(turned, turn * stress * turn.transpose(), kGlass, around.context);
  EXPECT_GT(pulled[0][0].z(), 0);
  for (std::size_t v = 0; v < pulled[0].size(); ++v) {
    EXPECT_LT((pressed[0][v] + 2 * pulled[0][v]).norm(), 1e-12 * pulled[0][0].norm());
    EXPECT_LT((again[0][v] - turn * pulled[0][v]).norm(), 1e-4 * pulled[0][0].norm());
  }
  for (const std::int32_t v : cracks[0].boundary) EXPECT_EQ(pulled[0][v].norm(), 0);
}

TEST(OpeningsInInfiniteBody, CracksAboveEachOtherShieldEachOther) {
  Surroundings around;
  Mat3 stress = Mat3::Zero();
  stress(2, 2) = 1e6;
  std::vector<CrackSheet> cracks{disc_crack(0.2, 3), disc_crack(0.2, 3)};
  for (Vec3& v : cracks[1].mesh.vertices) v.z() += 0.15;
  const auto two = openings_in_infinite_body(cracks, stress, kGlass, around.context);
  const auto one = openings_in_infinite_body({cracks.data(), 1}, stress, kGlass, around.context);
  EXPECT_LT(two[0][0].z(), 0.9 * one[0][0].z());
  EXPECT_NEAR(two[0][0].z(), two[1][0].z(), 1e-4 * one[0][0].z());
}

TEST(ConformCracks, MakesASurfaceCrackConformAndKeepsFrontAndVolume) {
  const TriangleMesh body = cube(8);
  const CrackSheet crack = flat_disc(0.6, 5, 0.07, [](const Vec3& p) { return p.x() > 0.1; });
  CrackSheet moved = crack;
  move_to_side(moved);
  const ConformedCracks conformed = conform_cracks(body, {&moved, 1});
  EXPECT_EQ(conformed.body.overshooting, 0);
  EXPECT_NEAR(volume(conformed.body.surface), 8, 1e-9);
  EXPECT_GE(conformed.body.mouths.size(), 4u);
  for (const MouthVertex& mouth : conformed.body.mouths) {
    EXPECT_NEAR(conformed.body.sheets[0].mesh.vertices[mouth.vertex].x(), 1, 1e-12);
  }
  for (std::size_t i = 0; i < conformed.source_boundary[0].size(); ++i) {
    const std::int32_t source = conformed.source_boundary[0][i];
    if (source < 0) continue;
    EXPECT_EQ(moved.mesh.vertices[moved.boundary[source]],
              conformed.body.sheets[0].mesh.vertices[conformed.body.sheets[0].boundary[i]]);
  }
  for (std::size_t f = 0; f < conformed.body.surface.faces.size(); ++f) {
    const Vec3 old = area_vector2(body, conformed.source_face[f]).normalized();
    EXPECT_GT(area_vector2(conformed.body.surface, f).normalized().dot(old), 0.999);
  }
}

/// The cube with a sheet through all of it.
ConformedCracks cut_through() {
  CrackSheet crack = flat_disc(1.5, 6, 0.07, [](const Vec3&) { return true; });
  for (Vec3& v : crack.mesh.vertices) {
    const double reach = std::max(std::abs(v.x()), std::abs(v.y()));
    if (reach > 0) v.head<2>() *= 1.03 * v.head<2>().norm() / 1.5 / reach;
  }
  return conform_cracks(cube(6), {&crack, 1});
}

TEST(RigidMotions, AreThoseOfEveryPartThatIsSeparate) {
  const ConformedCracks whole = conform_cracks(cube(4), {});
  EXPECT_EQ(rigid_motions(whole.body).cols(), 6);
  const ConformedCracks two = cut_through();
  ASSERT_EQ(two.body.overshooting, 0);
  const Eigen::MatrixXd motions = rigid_motions(two.body);
  ASSERT_EQ(motions.cols(), 12);
  EXPECT_LT((motions.transpose() * motions - Eigen::MatrixXd::Identity(12, 12)).norm(), 1e-12);
}

TEST(CrackSystem, SolvesABodyThatACrackHasCutInTwo) {
  Surroundings around;
  const ConformedCracks two = cut_through();
  CrackSystem system(kGlass, pull_along_z(1e6));
  const CrackedSolution solution = system.solve(two.body, around.context);
  EXPECT_EQ(solution.held, 0u);
  double largest = 0;
  for (const Vec3& u : solution.displacements) largest = std::max(largest, u.norm());
  EXPECT_GT(largest, 0);
  EXPECT_LT(largest, 10 * 1e6 / 7e10);
}

TEST(FullModel, GivesTheUncrackedStressWithoutCracksAndMoreAheadOfOne) {
  Surroundings around;
  const TriangleMesh body = cube(6);
  FullModel model = pulled_model(body, around.context);
  const SurfaceStress plain = model.surface_stress({});
  for (const Mat3& stress : plain.stress)
    EXPECT_LT((stress.diagonal() - Vec3(0, 0, 1e6)).norm(), 1e3);

  CrackSheet crack = flat_disc(0.6, 4, 0.07, [](const Vec3& p) { return p.x() > 0.1; });
  move_to_side(crack);
  const auto k = model.stress_intensity({&crack, 1});
  ASSERT_EQ(k.size(), 1u);
  ASSERT_EQ(k[0].size(), crack.boundary.size());
  for (std::size_t i = 0; i < k[0].size(); ++i) {
    if (crack.states[i] == FrontState::advancing) {
      EXPECT_GT(k[0][i].mode_1, 0.5e6);
      EXPECT_LT(std::abs(k[0][i].mode_2), 0.3 * k[0][i].mode_1);
    } else {
      EXPECT_EQ(k[0][i].mode_1, 0);
    }
  }
  const int solves = model.report().solves;
  model.surface_stress({&crack, 1});  // of the system that is solved already
  EXPECT_EQ(model.report().solves, solves);
  EXPECT_EQ(model.report().cracks_at_surface, 1);
  EXPECT_EQ(model.report().overshooting, 0);
}

TEST(FullModel, GivesTheSameBytesForAnyNumberOfThreads) {
  const TriangleMesh body = cube(4);
  const CrackSheet crack = flat_disc(0.5, 3, 0.05, [](const Vec3&) { return false; });
  std::vector<double> first;
  for (const int threads : {1, 2}) {
    Surroundings around;
    around.context.threads = threads;
    FullModel model = pulled_model(body, around.context);
    std::vector<double> values;
    const auto k = model.stress_intensity({&crack, 1});
    for (const StressIntensity& at : k[0]) values.push_back(at.mode_1);
    if (threads == 1) first = values;
    EXPECT_EQ(values, first);
  }
}

}  // namespace
}  // namespace fracbench::bem
