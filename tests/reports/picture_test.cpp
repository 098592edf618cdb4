#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reports/picture/draw.h"

namespace fracbench {
namespace {

/// A cube with a side of 2 around the origin.
TriangleMesh cube() {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.emplace_back(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
  }
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

DrawnMesh drawn(const TriangleMesh& mesh, const Vec3& colour) {
  return {.mesh = &mesh, .colours = std::vector<Vec3>(mesh.faces.size(), colour)};
}

struct Pixel {
  int r, g, b;
};

Pixel at(const Picture& p, int x, int y) {
  const std::size_t i = 3 * (static_cast<std::size_t>(y) * p.width + x);
  return {p.rgb[i], p.rgb[i + 1], p.rgb[i + 2]};
}

double share_drawn(const Picture& p) {
  int count = 0;
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x) {
      const Pixel c = at(p, x, y);
      count += c.r < 250 || c.g < 250 || c.b < 250;
    }
  }
  return static_cast<double>(count) / (p.width * p.height);
}

const View kAlongY{.towards = Vec3::UnitY(), .radius = std::sqrt(3.0)};

TEST(Draw, ShowsASquareFaceInItsPlaceAndSize) {
  // The front face lies at distance d - 1 from the eye, and half of it is seen under 1 / (d - 1).
  const TriangleMesh mesh = cube();
  const Picture p = draw({drawn(mesh, Vec3(1, 0, 0))}, kAlongY, 200, 200);
  const double half_view = 0.3;
  const double d = 1.08 * std::sqrt(3.0) * std::sqrt(1 + 1 / (half_view * half_view));
  const double side = 1 / (d - 1) / half_view;
  EXPECT_NEAR(share_drawn(p), side * side, 0.02);  // a row of pixels on each side
  const Pixel middle = at(p, 100, 100);
  EXPECT_GT(middle.r, 150);
  EXPECT_EQ(middle.g, 0);
  EXPECT_EQ(at(p, 2, 2).g, 255);
}

TEST(Draw, WhatIsInFrontHidesWhatIsBehind) {
  const TriangleMesh mesh = cube();
  DrawnMesh behind = drawn(mesh, Vec3(0, 0, 1));
  behind.shift = Vec3(0, 3, 0);
  for (const bool first : {true, false}) {
    std::vector<DrawnMesh> meshes{drawn(mesh, Vec3(1, 0, 0)), behind};
    if (!first) std::swap(meshes[0], meshes[1]);
    const Pixel middle = at(draw(meshes, kAlongY, 100, 100), 50, 50);
    EXPECT_GT(middle.r, 100);
    EXPECT_EQ(middle.b, 0);
  }
}

TEST(Draw, ZIsUpAndPosesMove) {
  const TriangleMesh mesh = cube();
  DrawnMesh up = drawn(mesh, Vec3(0, 1, 0));
  up.pose.position = Vec3(0, 0, 1);
  View view = kAlongY;
  view.radius = 4;
  const Picture p = draw({up}, view, 100, 100);
  EXPECT_LT(at(p, 50, 40).r, 100) << "above the middle";
  EXPECT_EQ(at(p, 50, 60).r, 255) << "below it";
}

TEST(Draw, AWireframeHasDarkLines) {
  const TriangleMesh mesh = cube();
  View view = kAlongY;
  view.wireframe = true;
  const Picture p = draw({drawn(mesh, Vec3(1, 1, 1))}, view, 200, 200);
  int dark = 0;
  for (int x = 0; x < 200; ++x) dark += at(p, x, 90).r < 120;
  EXPECT_GE(dark, 2) << "the sides and the diagonal of the front face";
  EXPECT_LE(dark, 12);
}

TEST(Draw, IsTheSameBytesEachTime) {
  const TriangleMesh mesh = cube();
  const View view{.radius = std::sqrt(3.0)};
  EXPECT_EQ(png_bytes(draw({drawn(mesh, Vec3(0.2, 0.5, 0.7))}, view, 120, 80)),
            png_bytes(draw({drawn(mesh, Vec3(0.2, 0.5, 0.7))}, view, 120, 80)));
}

TEST(Paste, CutsOffWhatDoesNotFit) {
  Picture to(4, 4);
  Picture from(3, 3);
  std::ranges::fill(from.rgb, 7);
  paste(from, 2, 2, to);
  EXPECT_EQ(at(to, 3, 3).r, 7);
  EXPECT_EQ(at(to, 1, 2).r, 255);
}

}  // namespace
}  // namespace fracbench
