#include "geometry/gs_sdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/random.h"
#include "geometry/partition_by_labels.h"
#include "geometry/signed_distance_grid.h"
#include "tests/geometry/reference_field.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

VoxelGrid<float> gs_sdf_of(const TriangleMesh& body, const Fragments& fragments, int r,
                           int threads = 2) {
  return gs_sdf(signed_distance_grid(body, unit_grid<float>(r)), fragments, threads);
}

/// The body cut into the cells of `sites` random points, with curved and flat, near and far
/// surfaces.
Fragments broken(const TriangleMesh& body, int sites, Random random) {
  std::vector<Vec3> points;
  for (int n = 0; n < sites; ++n) {
    points.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  }
  VoxelGrid<std::int32_t> labels = unit_grid<std::int32_t>(16);
  for (int k = 0; k < 16; ++k) {
    for (int j = 0; j < 16; ++j) {
      for (int i = 0; i < 16; ++i) {
        const auto nearest = std::ranges::min_element(points, {}, [&](const Vec3& p) {
          return (p - labels.position(i, j, k)).squaredNorm();
        });
        labels.at(i, j, k) = 1 + static_cast<std::int32_t>(nearest - points.begin());
      }
    }
  }
  Fragments fragments;
  for (Piece& piece : partition_by_labels(body, labels).pieces) {
    fragments.push_back({.mesh = std::move(piece.mesh), .faces = {}});
    for (const PieceFace& face : piece.faces) {
      fragments.back().faces.push_back({.original_face = face.parent_face});
    }
  }
  return fragments;
}

struct Broken {
  std::string name;
  TriangleMesh body;
  Fragments fragments;
};

std::vector<Broken> broken_bodies() {
  const std::vector<test_meshes::Named> bodies = {
      {"cube", test_meshes::cube(1.9)},
      {"sphere", test_meshes::sphere(12, 16, 0.95)},
      {"torus", test_meshes::torus(24, 12, 0.7, 0.25)},
      {"hollow cube", test_meshes::mapped(test_meshes::hollow_cube(),
                                          [](const Vec3& p) -> Vec3 { return 0.45 * p; })}};
  std::vector<Broken> result;
  for (const auto& [name, body] : bodies) {
    result.push_back({name, body, broken(body, 7, Random(derive_seed(3, {name})))});
  }
  return result;
}

double nearest_surface(const Fragments& fragments, const Vec3& p) {
  double nearest = HUGE_VAL;
  for (const Fragment& one : fragments) {
    nearest = std::min(nearest, reference::distance(one.mesh, p));
  }
  return nearest;
}

bool inside_any(const Fragments& fragments, const Vec3& p) {
  return std::ranges::any_of(fragments, [&](const Fragment& one) {
    return std::abs(reference::winding_number(one.mesh, p)) > 0.5;
  });
}

/// Equation (4) word by word.
double expected_at(const TriangleMesh& body, const Fragments& fragments, const Vec3& p) {
  return inside_any(fragments, p) ? nearest_surface(fragments, p) : -reference::distance(body, p);
}

TEST(GsSdf, IsExactAtRandomSamplesOfEveryResolution) {
  for (const auto& [name, body, fragments] : broken_bodies()) {
    ASSERT_GT(fragments.size(), 3u) << name;
    for (const int r : {7, 32, 64}) {
      const VoxelGrid<float> field = gs_sdf_of(body, fragments, r);
      Random random(derive_seed(4, {name, std::to_string(r)}));
      for (int n = 0; n < 150; ++n) {
        const auto pick = [&] { return static_cast<int>(random.below(r)); };
        const int i = pick(), j = pick(), k = pick();
        const double expected = expected_at(body, fragments, field.position(i, j, k));
        // Float rounding.
        EXPECT_NEAR(field.at(i, j, k), expected, 1e-12 + 6.1e-8 * std::abs(expected))
            << name << " " << r << " at " << field.position(i, j, k).transpose();
      }
    }
  }
}

TEST(GsSdf, OfAWholeBodyIsItsSignedDistance) {
  for (const auto& [name, body, fragments] : broken_bodies()) {
    Fragment whole{.mesh = body, .faces = {}};
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      whole.faces.push_back({.original_face = static_cast<std::int32_t>(f)});
    }
    EXPECT_EQ(gs_sdf_of(body, {whole}, 15).values,
              signed_distance_grid(body, unit_grid<float>(15)).values)
        << name;
  }
}

TEST(GsSdf, FragmentsThatFillTheBodyLeaveItsSignsAsTheyAre) {
  for (const auto& [name, body, fragments] : broken_bodies()) {
    const VoxelGrid<float> field = gs_sdf_of(body, fragments, 24);
    const VoxelGrid<float> distance = signed_distance_grid(body, unit_grid<float>(24));
    for (std::size_t v = 0; v < field.values.size(); ++v) {
      EXPECT_EQ(field.values[v] > 0, distance.values[v] > 0) << name;
      EXPECT_LE(field.values[v], distance.values[v]) << name;  // cracks only come nearer
      if (distance.values[v] < 0) {
        EXPECT_EQ(field.values[v], distance.values[v]) << name;
      }
    }
  }
}

TEST(GsSdf, TruncationLimitsBothSides) {
  const VoxelGrid<float> full = signed_distance_grid(test_meshes::cube(1.9), unit_grid<float>(9));
  VoxelGrid<float> cut = full;
  truncate(cut, 0.04);
  for (std::size_t v = 0; v < full.values.size(); ++v) {
    EXPECT_EQ(cut.values[v], std::clamp(full.values[v], -0.04f, 0.04f));
  }
}

TEST(GsSdf, IsTheSameBytesForAnyNumberOfThreads) {
  for (const auto& [name, body, fragments] : broken_bodies()) {
    const VoxelGrid<float> one = gs_sdf_of(body, fragments, 21, 1);
    const VoxelGrid<float> many = gs_sdf_of(body, fragments, 21, 3);
    EXPECT_EQ(std::memcmp(one.values.data(), many.values.data(), one.values.size() * sizeof(float)),
              0)
        << name;
  }
}

TEST(FragmentLabels, SayInWhichFragmentEachSampleLies) {
  for (const auto& [name, body, fragments] : broken_bodies()) {
    const VoxelGrid<std::int32_t> labels =
        fragment_labels(fragments, unit_grid<std::int32_t>(19), 2);
    Random random(derive_seed(5, {name}));
    for (int n = 0; n < 300; ++n) {
      const auto pick = [&] { return static_cast<int>(random.below(19)); };
      const int i = pick(), j = pick(), k = pick();
      const Vec3 p = labels.position(i, j, k);
      std::int32_t expected = -1;
      for (std::size_t f = 0; f < fragments.size(); ++f) {
        if (std::abs(reference::winding_number(fragments[f].mesh, p)) > 0.5) {
          expected = static_cast<std::int32_t>(f) + 1;
        }
      }
      EXPECT_EQ(labels.at(i, j, k), expected) << name;
    }
  }
}

}  // namespace
}  // namespace fracbench
