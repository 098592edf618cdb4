#include "scenarios/shapes/generated_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/digest.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"

namespace fracbench {
namespace {

/// Coarse, where thin parts come close, the default, and fine.
std::vector<int> resolutions(const GeneratedShape& shape) {
  std::vector<int> result;
  for (int r = shape.least_resolution; r < shape.least_resolution + 8; ++r) result.push_back(r);
  for (int r = shape.least_resolution + 8; r < shape.default_resolution; r += 5)
    result.push_back(r);
  result.push_back(shape.default_resolution);
  result.push_back(shape.default_resolution * 3 / 2);
  return result;
}

const GeneratedShape& find(std::string_view name) {
  for (const GeneratedShape& shape : generated_shapes()) {
    if (shape.name == name) return shape;
  }
  throw std::logic_error("no such shape");
}

long long euler_characteristic(const TriangleMesh& mesh) {
  // A closed mesh has three edges for two faces.
  const auto faces = static_cast<long long>(mesh.faces.size());
  return static_cast<long long>(mesh.vertices.size()) - 3 * faces / 2 + faces;
}

double smallest_angle(const TriangleMesh& mesh) {
  double smallest = 180;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 u = mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k);
      const Vec3 v = mesh.corner(f, (k + 2) % 3) - mesh.corner(f, k);
      const double angle = std::atan2(u.cross(v).norm(), u.dot(v));
      smallest = std::min(smallest, angle * 180 / std::numbers::pi);
    }
  }
  return smallest;
}

double blocks_volume(const std::vector<Block>& blocks) {
  double sum = 0;
  for (const Block& block : blocks) sum += (block.high - block.low).prod();
  return sum;
}

/// Volume of revolution of a finely sampled profile: the sum of its conical frustums.
double revolution_volume(const Profile& profile) {
  double sum = 0;
  for (const ProfilePiece& piece : profile) {
    const std::vector<ProfilePoint> points = sample(piece, 1e-4);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double r = points[i].x(), s = points[i + 1].x();
      sum += std::numbers::pi / 3 * (r * r + r * s + s * s) * (points[i + 1].y() - points[i].y());
    }
  }
  return sum;
}

TEST(GeneratedShapes, AreSolidsAtEveryResolution) {
  for (const GeneratedShape& shape : generated_shapes()) {
    for (const int resolution : resolutions(shape)) {
      const MeshReport report = check_mesh(shape.make(resolution));
      EXPECT_TRUE(report.is_solid())
          << shape.name << " " << resolution << ": " << report.describe();
      EXPECT_EQ(report.components, 1u) << shape.name << " " << resolution;
    }
  }
}

TEST(GeneratedShapes, HaveTheirGenusAtEveryResolution) {
  const std::vector<std::pair<std::string_view, int>> genus = {
      {"bar", 0},   {"pot", 0},    {"mug", 1},    {"A", 1},
      {"chair", 2}, {"plinth", 0}, {"sphere", 0}, {"cube", 0}};
  ASSERT_EQ(genus.size(), generated_shapes().size());
  for (const auto& [name, holes] : genus) {
    for (const int resolution : resolutions(find(name))) {
      EXPECT_EQ(euler_characteristic(find(name).make(resolution)), 2 - 2 * holes)
          << name << " " << resolution;
    }
  }
}

TEST(GeneratedShapes, HaveSomeThousandWellShapedFacesByDefault) {
  for (const GeneratedShape& shape : generated_shapes()) {
    const TriangleMesh mesh = shape.make(shape.default_resolution);
    EXPECT_GE(mesh.faces.size(), 1500u) << shape.name;
    EXPECT_LE(mesh.faces.size(), 20000u) << shape.name;
    EXPECT_GT(smallest_angle(mesh), 20) << shape.name;
  }
}

TEST(GeneratedShapes, FinerResolutionsHaveSmallerFaces) {
  for (const GeneratedShape& shape : generated_shapes()) {
    const auto faces = [&](int resolution) {
      return static_cast<double>(shape.make(resolution).faces.size());
    };
    EXPECT_NEAR(faces(2 * shape.default_resolution) / faces(shape.default_resolution), 4, 0.8)
        << shape.name;
  }
}

TEST(GeneratedShapes, AreTheSameBytesEachTime) {
  for (const GeneratedShape& shape : generated_shapes()) {
    const auto digest = [&] {
      Digest result;
      result.add(shape.make(shape.default_resolution));
      return result.hex();
    };
    EXPECT_EQ(digest(), digest()) << shape.name;
  }
}

TEST(GeneratedShapes, ThoseOfBlocksHaveTheSumOfTheirVolumes) {
  const std::vector<std::pair<std::string_view, std::vector<Block>>> shapes = {
      {"bar", bar_blocks()}, {"cube", cube_blocks()}, {"chair", chair_blocks()}};
  for (const auto& [name, blocks] : shapes) {
    for (const int resolution : resolutions(find(name))) {
      EXPECT_NEAR(volume(find(name).make(resolution)), blocks_volume(blocks), 1e-13)
          << name << " " << resolution;
    }
  }
  EXPECT_DOUBLE_EQ(blocks_volume(bar_blocks()), 1.9 * 0.3 * 0.3);
}

TEST(GeneratedShapes, TheLetterHasTheAreaOfItsOutlinesTimesItsDepth) {
  // Trapezium less the gap between the legs (a trapezium) less the hole (a triangle).
  const double outline = (1.6 + 0.44) / 2 * 1.9 - (0.9 + 0.66) / 2 * 0.4 - 0.48 / 2 * 0.8;
  for (const int resolution : resolutions(find("A"))) {
    EXPECT_NEAR(volume(find("A").make(resolution)), outline * letter_a_depth(), 1e-12);
  }
}

TEST(GeneratedShapes, TheSphereConvergesWithTheSecondOrder) {
  // The second order in the length of an edge is the first in the number of faces.
  const TriangleMesh coarse = sphere_mesh(16), fine = sphere_mesh(128);
  const double exact = 4 * std::numbers::pi / 3;
  const double order = std::log((exact - volume(coarse)) / (exact - volume(fine))) /
                       std::log(double(fine.faces.size()) / double(coarse.faces.size()));
  EXPECT_NEAR(order, 1, 0.02);
}

TEST(GeneratedShapes, SolidsOfRevolutionConvergeToPappus) {
  const std::vector<std::pair<std::string_view, Profile>> shapes = {{"pot", pot_profile()},
                                                                    {"plinth", plinth_profile()}};
  for (const auto& [name, profile] : shapes) {
    const double exact = revolution_volume(profile);
    const auto error = [&](int resolution) {
      return std::abs(volume(find(name).make(resolution)) / exact - 1);
    };
    EXPECT_LT(error(24), 0.02) << name;
    EXPECT_LT(error(48), 0.005) << name;
    EXPECT_LT(error(200), 0.0005) << name;
    // Numbers of segments are rounded, so that the order shows over large steps only.
    EXPECT_GT(std::log2(error(48) / error(384)) / 3, 1.8) << name;
  }
}

}  // namespace
}  // namespace fracbench
