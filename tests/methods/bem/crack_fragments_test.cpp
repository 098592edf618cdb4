#include "methods/bem/crack_fragments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/random.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "scenarios/shapes.h"
#include "tests/methods/bem/sheets.h"
#include "tests/methods/cvd/bodies.h"
#include "tests/methods/cvd/check_pieces.h"

namespace fracbench::test {
namespace {

using namespace bem;

TriangleMesh shape(const std::string& name) { return load_shape({.name = name}).mesh; }

CrackFragments fragments_of(const TriangleMesh& body, const CutLinks& links, int threads = 1,
                            const FragmentOptions& options = {}) {
  Random random(1);
  StageTimer timer;
  Progress progress;
  const Context context{random, timer, progress, {}, threads};
  return crack_fragments(body, links, options, context);
}

/// A gently curved sheet that reaches beyond every body.
void cut_through(CutLinks& links, Random& random, std::int32_t crack, double half_width = 2) {
  const Vec3 n = random.unit_vector(), u = n.unitOrthogonal(), v = n.cross(u);
  const double offset = random.uniform(-0.3, 0.3), bend = random.uniform(-0.1, 0.1);
  for (const auto& triangle : sheet(60, [&](double s, double t) {
         return Vec3((offset + bend * (s * s - t * t)) * n + half_width * (s * u + t * v));
       })) {
    links.cut(triangle, crack);
  }
}

TEST(CrackFragments, FillEveryGeneratedShapeAndKeepItsSurface) {
  for (const ShapeInfo& info : list_shapes()) {
    if (info.source != "generated") continue;
    SCOPED_TRACE(info.name);
    const TriangleMesh body = shape(info.name);
    CutLinks links(body, 0.04, 1);
    Random random(7);
    for (int crack = 0; crack < 4; ++crack) cut_through(links, random, crack);
    const CrackFragments result = fragments_of(body, links);
    EXPECT_GE(result.pieces.size(), 3u);
    EXPECT_EQ(result.label_of.size(), result.pieces.size());
    expect_partition(body, result.pieces);
  }
}

TEST(CrackFragments, FillTheDevelopmentShapesAndKeepTheirSurface) {
  const std::vector<Body> bodies = filed_bodies();
  if (bodies.empty()) GTEST_SKIP() << "../shared/meshes is not there";
  for (const Body& body : bodies) {
    SCOPED_TRACE(body.name);
    const TriangleMesh mesh = normalized(body.mesh, 1.9);
    CutLinks links(mesh, 0.03, 1);
    Random random(3);
    for (int crack = 0; crack < 3; ++crack) cut_through(links, random, crack);
    expect_partition(mesh, fragments_of(mesh, links).pieces);
  }
}

TEST(CrackFragments, OfABodyThatIsNotSeparatedAreTheBodyItself) {
  const TriangleMesh body = shape("cube");
  CutLinks links(body, 0.05, 1);
  Random random(5);
  cut_through(links, random, 0, 0.5);
  const CrackFragments result = fragments_of(body, links);
  ASSERT_EQ(result.pieces.size(), 1u);
  EXPECT_EQ(result.pieces[0].mesh.vertices, body.vertices);
  EXPECT_EQ(result.pieces[0].mesh.faces, body.faces);
  EXPECT_EQ(result.pieces[0].faces[5].parent_face, 5);
  EXPECT_EQ(result.report.cracks_within, 1u);
  EXPECT_EQ(result.report.separating_cracks, 0u);
}

TEST(CrackFragments, CountTheCracksThatSeparateNothing) {
  const TriangleMesh body = shape("cube");
  CutLinks links(body, 0.05, 1);
  Random random(5);
  cut_through(links, random, 0, 0.4);
  cut_through(links, random, 1);
  const CrackFragments result = fragments_of(body, links);
  EXPECT_EQ(result.pieces.size(), 2u);
  EXPECT_EQ(result.report.cracks_within, 1u);
  EXPECT_EQ(result.report.separating_cracks, 1u);
}

TEST(CrackFragments, BelowTheSmallestSizeGoToANeighbour) {
  const TriangleMesh body = shape("cube");
  CutLinks links(body, 0.05, 1);
  // A closed box of a few voxels, and a sheet that divides the body.
  const double r = 0.11;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      for (const auto& triangle : sheet(4, [&](double s, double t) {
             Vec3 p;
             p[axis] = side * r;
             p[(axis + 1) % 3] = s * r;
             p[(axis + 2) % 3] = t * r;
             return p;
           })) {
        links.cut(triangle, 0);
      }
    }
  }
  for (const auto& triangle :
       sheet(40, [](double s, double t) { return Vec3(0.5, 1.5 * s, 1.5 * t); })) {
    links.cut(triangle, 1);
  }
  const CrackFragments all = fragments_of(body, links);
  EXPECT_EQ(all.pieces.size(), 3u);
  EXPECT_EQ(all.report.merged_parts, 0u);
  const CrackFragments merged = fragments_of(body, links, 1, {.smallest = 0.01});
  ASSERT_EQ(merged.pieces.size(), 2u);
  EXPECT_EQ(merged.report.parts, 3u);
  EXPECT_EQ(merged.report.merged_parts, 1u);
  EXPECT_NEAR(merged.report.merged_volume, std::pow(2 * r, 3), 0.5 * std::pow(2 * r, 3));
  expect_partition(body, merged.pieces);
  const double corner = std::pow(2 * r / links.spacing(), 3);
  EXPECT_EQ(fragments_of(body, links, 1, {.smallest_voxels = corner / 2}).pieces.size(), 3u);
  EXPECT_EQ(fragments_of(body, links, 1, {.smallest_voxels = corner * 2}).pieces.size(), 2u);
}

TEST(CrackFragments, HaveSmoothFractureSurfaces) {
  const TriangleMesh body = shape("cube");
  CutLinks links(body, 0.03, 1);
  const Vec3 n = Vec3(1, 2, 3).normalized(), u = n.unitOrthogonal(), v = n.cross(u);
  for (const auto& triangle :
       sheet(60, [&](double s, double t) { return Vec3(2.0 * (s * u + t * v)); })) {
    links.cut(triangle, 0);
  }
  const CrackFragments result = fragments_of(body, links);
  ASSERT_EQ(result.pieces.size(), 2u);
  double area = 0, deviation = 0, farthest = 0;
  const Piece& piece = result.pieces[0];
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    if (!piece.faces[f].is_fracture()) continue;
    const Vec3 normal = area_vector2(piece.mesh, f);
    area += normal.norm();
    deviation += normal.norm() * std::acos(std::min(1.0, std::abs(normal.normalized().dot(n))));
    for (int k = 0; k < 3; ++k) {
      farthest = std::max(farthest, std::abs(n.dot(piece.mesh.corner(f, k))));
    }
  }
  EXPECT_LT(deviation / area, 0.1) << "rad, of the normals on average";
  EXPECT_LT(farthest, 0.03) << "a voxel";
}

TEST(CrackFragments, AreTheSameForAnyNumberOfThreads) {
  const TriangleMesh body = shape("mug");
  CutLinks links(body, 0.03, 1);
  Random random(9);
  for (int crack = 0; crack < 3; ++crack) cut_through(links, random, crack);
  const CrackFragments one = fragments_of(body, links, 1), two = fragments_of(body, links, 2);
  ASSERT_EQ(one.pieces.size(), two.pieces.size());
  for (std::size_t p = 0; p < one.pieces.size(); ++p) {
    EXPECT_EQ(one.pieces[p].mesh.vertices, two.pieces[p].mesh.vertices);
    EXPECT_EQ(one.pieces[p].mesh.faces, two.pieces[p].mesh.faces);
    EXPECT_EQ(one.pieces[p].faces, two.pieces[p].faces);
  }
}

TEST(CrackFragments, UnderParityAreReMeshedFromTheGrid) {
  const TriangleMesh body = shape("cube");
  CutLinks links(body, 0.04, 1);
  Random random(7);
  for (int crack = 0; crack < 3; ++crack) cut_through(links, random, crack);
  const CrackFragments result = fragments_of(body, links, 2, {.parity = true});
  ASSERT_GE(result.pieces.size(), 3u);
  double sum = 0;
  std::size_t original = 0, faces = 0, neighbours = 0;
  for (const Piece& piece : result.pieces) {
    EXPECT_TRUE(check_mesh(piece.mesh).is_solid());
    sum += volume(piece.mesh);
    faces += piece.faces.size();
    ASSERT_EQ(piece.faces.size(), piece.mesh.faces.size());
    for (const PieceFace& face : piece.faces) {
      original += !face.is_fracture();
      neighbours += face.neighbour >= 0;
    }
  }
  EXPECT_NEAR(sum / volume(body), 1, 0.1);
  EXPECT_GT(original, faces / 4);
  EXPECT_GT(neighbours, faces / 10);
}

TEST(CrackFragments, UnderParityAreConvexHullsWhereTheyAreSmall) {
  const TriangleMesh body = shape("A");  // not convex
  const CutLinks links(body, 0.04, 1);
  CutLinks cut(body, 0.04, 1);
  Random random(2);
  for (int crack = 0; crack < 3; ++crack) cut_through(cut, random, crack);
  const CrackFragments hulls = fragments_of(body, cut, 1, {.parity = true, .hull_share = 1});
  for (const Piece& piece : hulls.pieces) {
    for (std::size_t f = 0; f < piece.mesh.faces.size(); ++f) {
      const Vec3 n = area_vector2(piece.mesh, f).normalized();
      for (const Vec3& v : piece.mesh.vertices) {
        EXPECT_LT(n.dot(v - piece.mesh.corner(f, 0)), 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace fracbench::test
