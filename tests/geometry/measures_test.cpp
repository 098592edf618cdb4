#include "geometry/measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;

/// Scale against which errors of lengths are judged: the offset from the origin counts.
double reach(const TriangleMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  return box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).maxCoeff();
}

void expect_inertia(const Mat3& actual, const Mat3& expected, double relative) {
  EXPECT_LE((actual - expected).norm(), relative * expected.norm()) << actual << "\nexpected\n"
                                                                    << expected;
}

TEST(MassProperties, OfABoxAreTheClosedForm) {
  const Vec3 low(-1, 2, 3), high(1, 5, 7);
  const Vec3 s = high - low;
  const MassProperties box_properties = mass_properties(box(low, high));
  EXPECT_NEAR(box_properties.volume, 24, 1e-13);
  EXPECT_NEAR((box_properties.center - (low + high) / 2).norm(), 0, 1e-14);
  const Vec3 diagonal(s.y() * s.y() + s.z() * s.z(), s.x() * s.x() + s.z() * s.z(),
                      s.x() * s.x() + s.y() * s.y());
  expect_inertia(box_properties.inertia, 24.0 / 12 * Mat3(diagonal.asDiagonal()), 1e-14);
}

TEST(MassProperties, OfTheCornerTetrahedronAreTheClosedForm) {
  const MassProperties tet = mass_properties(tetrahedron());
  EXPECT_NEAR(tet.volume, 1.0 / 6, 1e-16);
  EXPECT_NEAR((tet.center - Vec3::Constant(0.25)).norm(), 0, 1e-15);
  // Integrals of x^2 and x y over it: 1/60 and 1/120; moved to the centre by the volume times 1/16.
  const double square = 1.0 / 60 - 1.0 / 96;
  const double product = 1.0 / 120 - 1.0 / 96;
  Mat3 expected = Mat3::Constant(-product);
  expected.diagonal().setConstant(2 * square);
  expect_inertia(tet.inertia, expected, 1e-14);
}

TEST(MassProperties, OfASphereConvergeWithOrderTwo) {
  const double volume_exact = 4 * std::numbers::pi / 3;
  const double inertia_exact = 8 * std::numbers::pi / 15;
  const double area_exact = 4 * std::numbers::pi;
  const auto errors = [&](int n) {
    const TriangleMesh mesh = sphere(n, 2 * n);
    const MassProperties properties = mass_properties(mesh);
    return Vec3(properties.volume / volume_exact - 1, properties.inertia(0, 0) / inertia_exact - 1,
                area(mesh) / area_exact - 1);
  };
  const Vec3 coarse = errors(32), fine = errors(64);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::log2(coarse[i] / fine[i]), 2, 0.02) << "quantity " << i;
  }
}

TEST(MassProperties, AgreeWithVolumeOnEverySolid) {
  for (const auto& [name, mesh] : solids()) {
    EXPECT_DOUBLE_EQ(mass_properties(mesh).volume, volume(mesh)) << name;
    EXPECT_GT(volume(mesh), 0) << name;
  }
}

TEST(MassProperties, FollowARotationAndATranslation) {
  const Mat3 turn(Eigen::AngleAxisd(1.1, Vec3(3, -1, 2).normalized()));
  const Vec3 shift(0.3, -7, 2);
  for (const auto& [name, mesh] : solids()) {
    SCOPED_TRACE(name);
    const TriangleMesh other = mapped(mesh, [&](const Vec3& v) { return Vec3(turn * v + shift); });
    const MassProperties before = mass_properties(mesh), after = mass_properties(other);
    // What the moved vertices' own rounding does to the volume.
    const double rounding = 1e-15 * (reach(mesh) + 8) * area(mesh) / before.volume + 1e-13;
    EXPECT_NEAR(after.volume / before.volume, 1, rounding);
    EXPECT_NEAR((after.center - (turn * before.center + shift)).norm(), 0,
                rounding * (reach(mesh) + 8));
    expect_inertia(after.inertia, turn * before.inertia * turn.transpose(), 10 * rounding);
  }
}

TEST(MassProperties, ScaleWithTheThirdAndFifthPowerOfLength) {
  for (const auto& [name, mesh] : solids()) {
    SCOPED_TRACE(name);
    // A power of two scales without rounding.
    const TriangleMesh other = mapped(mesh, [](const Vec3& v) { return Vec3(4 * v); });
    const MassProperties before = mass_properties(mesh), after = mass_properties(other);
    EXPECT_EQ(after.volume, 64 * before.volume);
    EXPECT_EQ(after.center, 4 * before.center);
    EXPECT_EQ(after.inertia, 1024 * before.inertia);
    EXPECT_EQ(area(other), 16 * area(mesh));
  }
}

TEST(MassProperties, AddUpOverParts) {
  const TriangleMesh left = box(Vec3(0, 0, 0), Vec3(1, 2, 3));
  const TriangleMesh right = moved(sphere(12, 16), Vec3(5, 1, -2));
  const MassProperties a = mass_properties(left), b = mass_properties(right);
  const MassProperties both = mass_properties(joined({left, right}));
  EXPECT_NEAR(both.volume, a.volume + b.volume, 1e-13);
  const Vec3 center = (a.volume * a.center + b.volume * b.center) / both.volume;
  EXPECT_NEAR((both.center - center).norm(), 0, 1e-14);
  Mat3 inertia = a.inertia + b.inertia;
  for (const MassProperties* part : {&a, &b}) {
    const Vec3 d = part->center - center;
    inertia += part->volume * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  }
  expect_inertia(both.inertia, inertia, 1e-13);
}

TEST(MassProperties, OfACavityAreSubtracted) {
  EXPECT_DOUBLE_EQ(volume(hollow_cube()), 7);
  EXPECT_NEAR(mass_properties(hollow_cube()).inertia(1, 1), (32.0 - 1.0) / 6, 1e-14);
}

TEST(MassProperties, OfAnInvertedMeshHaveNegativeVolumeAndTheSameCentre) {
  const TriangleMesh mesh = tetrahedron();
  EXPECT_EQ(volume(flipped(mesh)), -volume(mesh));
  EXPECT_NEAR((mass_properties(flipped(mesh)).center - Vec3::Constant(0.25)).norm(), 0, 1e-15);
}

TEST(MassProperties, OfAFlatOrEmptyMeshAreFinite) {
  TriangleMesh flat;
  flat.vertices = {Vec3(0, 0, 1), Vec3(2, 0, 1), Vec3(0, 2, 1)};
  flat.faces = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(mass_properties(flat).volume, 0);
  EXPECT_EQ(mass_properties(flat).center, Vec3(1, 1, 1));
  EXPECT_EQ(mass_properties({}).volume, 0);
  EXPECT_EQ(area({}), 0);
}

TEST(Measures, KeepTheirDigitsFarFromTheOrigin) {
  const TriangleMesh far = moved(cube(), Vec3::Constant(1 << 20));
  EXPECT_DOUBLE_EQ(volume(far), 8);
  EXPECT_DOUBLE_EQ(area(far), 24);
}

TEST(BoundingBox, CoversTheCornersOfTheFacesAndNoOtherVertex) {
  TriangleMesh mesh = box(Vec3(-1, 2, 3), Vec3(1, 5, 7));
  mesh.vertices.push_back(Vec3(100, 100, 100));
  EXPECT_EQ(bounding_box(mesh).low, Vec3(-1, 2, 3));
  EXPECT_EQ(bounding_box(mesh).high, Vec3(1, 5, 7));
  EXPECT_EQ(bounding_box(mesh).center(), Vec3(0, 3.5, 5));
  EXPECT_EQ(bounding_box(mesh).longest_side(), 4);
}

TEST(Normalized, CentresTheBoxAndSetsItsLongestSide) {
  for (const auto& [name, mesh] : solids()) {
    const BoundingBox result = bounding_box(normalized(mesh, 1.9));
    EXPECT_NEAR(result.longest_side(), 1.9, 1e-9) << name;
    EXPECT_NEAR(result.center().norm(), 0, 1e-9) << name;
  }
}

TEST(Normalized, LeavesAMeshThatIsAlreadySoBitForBit) {
  for (const auto& [name, mesh] : solids()) {
    const TriangleMesh once = normalized(mesh, 1.9);
    EXPECT_EQ(normalized(once, 1.9).vertices, once.vertices) << name;
  }
  const TriangleMesh nearly = moved(cube(1.9), Vec3(1e-6, 0, 0));
  EXPECT_EQ(normalized(nearly, 1.9).vertices, nearly.vertices);
  const TriangleMesh not_quite = moved(cube(1.9), Vec3(3e-6, 0, 0));
  EXPECT_NE(normalized(not_quite, 1.9).vertices, not_quite.vertices);
}

}  // namespace
}  // namespace fracbench
