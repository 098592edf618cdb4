#include "methods/modes/tet_mesh.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/error.h"
#include "geometry/measures.h"
#include "methods/modes/tetrahedralise.h"
#include "methods/modes/validation/shapes.h"

namespace fracbench::modes {
namespace {

TetMesh two_tets() {
  // Share the face 0-1-2; the second is given inside out.
  return make_tet_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -2}},
                       {{0, 1, 2, 3}, {0, 1, 2, 4}});
}

TEST(TetMesh, HasTheVolumesAndTheSharedFaceOfTwoTets) {
  const TetMesh mesh = two_tets();
  EXPECT_NEAR(mesh.volumes[0], 1.0 / 6, 1e-15);
  EXPECT_NEAR(mesh.volumes[1], 1.0 / 3, 1e-15);
  EXPECT_EQ(mesh.boundary_faces.size(), 6u);
  ASSERT_EQ(mesh.interior_faces.size(), 1u);
  EXPECT_NEAR(mesh.interior_faces[0].area, 0.5, 1e-15);
}

TEST(TetMesh, TurnsFacesOutOfTheirTet) {
  const TetMesh mesh = two_tets();
  Vec3 sum = Vec3::Zero();
  double volume = 0;
  for (const auto& face : mesh.boundary_faces) {
    const Vec3& a = mesh.vertices[face.corners[0]];
    const Vec3 normal =
        (mesh.vertices[face.corners[1]] - a).cross(mesh.vertices[face.corners[2]] - a) / 2;
    sum += normal;
    volume += normal.dot(a) / 3;
  }
  EXPECT_LT(sum.norm(), 1e-15);
  EXPECT_NEAR(volume, mesh.volume(), 1e-15);
  const auto& inner = mesh.interior_faces[0];
  const Vec3& a = mesh.vertices[inner.corners[0]];
  const Vec3 normal =
      (mesh.vertices[inner.corners[1]] - a).cross(mesh.vertices[inner.corners[2]] - a);
  EXPECT_LT(normal.z(), 0);  // out of the first tet, which is above
}

TEST(TetMesh, RefusesFlatTetsWrongIndicesAndFacesOfThreeTets) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0},  {0, 1, 0},
                                    {0, 0, 1}, {0, 0, -1}, {1, 1, 2}};
  EXPECT_THROW(make_tet_mesh(points, {{0, 1, 2, 2}}), MethodFailure);
  EXPECT_THROW(make_tet_mesh(points, {{0, 1, 2, 6}}), MethodFailure);
  EXPECT_THROW(make_tet_mesh(points, {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}}), MethodFailure);
}

TEST(UnitBox, HasLongestSideOneAndGoesBack) {
  const UnitBox box = unit_box(notched_bar());
  EXPECT_EQ(box.size, 4);
  EXPECT_EQ(box.center, Vec3(2, 0.5, 0.5));
  const Vec3 x(0.3, -2, 5);
  EXPECT_LT((box.to_body(box.to_unit(x)) - x).norm(), 1e-15);
  EXPECT_THROW(unit_box({}), InputError);
}

TEST(Tetrahedralise, FillsTheShapesOfTheReferenceTable) {
  for (const TriangleMesh& shape :
       {plain_bar(), notched_bar(), l_shape(), plate_with_hole(), dumbbell()}) {
    const Tets tets = tetrahedralise(shape, {.largest_volume = 0.01}, "shape");
    const TetMesh mesh = make_tet_mesh(tets.vertices, tets.tets);
    EXPECT_NEAR(mesh.volume(), volume(shape), 1e-12 * volume(shape));
    for (const double v : mesh.volumes) EXPECT_LE(v, 0.01 * (1 + 1e-9));
  }
}

TEST(Tetrahedralise, LeavesCavitiesEmpty) {
  TriangleMesh shape = plain_bar();
  TriangleMesh cavity = plain_bar();
  for (Vec3& v : cavity.vertices) v = v * 0.5 + Vec3(1, 0.25, 0.25);
  for (const Face& f : cavity.faces) {
    shape.faces.push_back({f[0] + 8, f[2] + 8, f[1] + 8});
  }
  shape.vertices.insert(shape.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
  const Tets tets = tetrahedralise(shape, {}, "hollow bar");
  EXPECT_NEAR(make_tet_mesh(tets.vertices, tets.tets).volume(), 4 - 0.5, 1e-12);
}

TEST(Tetrahedralise, PassesOnWhyASurfaceThatCrossesItselfFails) {
  TriangleMesh shape = plain_bar();
  TriangleMesh other = plain_bar();
  for (const Face& f : other.faces) shape.faces.push_back({f[0] + 8, f[1] + 8, f[2] + 8});
  for (Vec3& v : other.vertices) shape.vertices.push_back(v + Vec3(0.5, 0.3, 0.2));
  try {
    tetrahedralise(shape, {}, "crossing bars");
    FAIL();
  } catch (const MethodFailure& failure) {
    const std::string text = failure.what();
    EXPECT_NE(text.find("crossing bars"), std::string::npos) << text;
    EXPECT_NE(text.find("intersects itself"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace fracbench::modes
