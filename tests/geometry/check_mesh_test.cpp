#include "geometry/check_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "geometry/measures.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;
using testing::HasSubstr;

const MeshReport::Finding* find(const MeshReport& report, const std::string& kind) {
  for (const auto& finding : report.findings) {
    if (finding.kind == kind) return &finding;
  }
  return nullptr;
}

std::size_t count(const MeshReport& report, const std::string& kind) {
  const MeshReport::Finding* finding = find(report, kind);
  return finding ? finding->count : 0;
}

TEST(CheckMesh, FindsNothingWrongWithSolids) {
  for (const auto& [name, mesh] : solids()) {
    const MeshReport report = check_mesh(mesh);
    EXPECT_TRUE(report.is_solid()) << name << ": " << report.describe();
    EXPECT_EQ(report.describe(), "solid");
    EXPECT_EQ(report.vertices, mesh.vertices.size());
    EXPECT_EQ(report.faces, mesh.faces.size());
    EXPECT_EQ(report.volume, volume(mesh));
  }
}

TEST(CheckMesh, FindsEverySolidInvertedOnceItIsFlipped) {
  for (const auto& [name, mesh] : solids()) {
    const MeshReport report = check_mesh(flipped(mesh));
    EXPECT_TRUE(report.closed && report.manifold) << name;
    EXPECT_FALSE(report.oriented) << name;
    EXPECT_FALSE(report.is_solid()) << name;
    EXPECT_EQ(count(report, "inverted shell"), report.components) << name;
  }
}

TEST(CheckMesh, FindsTheThreeEdgesOfEveryFaceThatIsTakenOut) {
  for (const auto& [name, mesh] : solids()) {
    TriangleMesh open = mesh;
    open.faces.erase(open.faces.begin() + open.faces.size() / 2);
    const MeshReport report = check_mesh(open);
    EXPECT_FALSE(report.closed) << name;
    EXPECT_FALSE(report.is_solid()) << name;
    EXPECT_EQ(count(report, "open edge"), 3u) << name;
  }
}

TEST(CheckMesh, FindsTheThreeEdgesOfEveryFaceThatIsTurned) {
  for (const auto& [name, mesh] : solids()) {
    TriangleMesh turned = mesh;
    std::swap(turned.faces[3][0], turned.faces[3][1]);
    const MeshReport report = check_mesh(turned);
    EXPECT_TRUE(report.closed) << name;
    EXPECT_FALSE(report.oriented) << name;
    EXPECT_EQ(count(report, "edge between opposed faces"), 3u) << name;
  }
}

TEST(CheckMesh, CountsComponents) {
  EXPECT_EQ(check_mesh(cube()).components, 1u);
  EXPECT_EQ(check_mesh(hollow_cube()).components, 2u);
  EXPECT_EQ(check_mesh(nested_spheres(4)).components, 4u);
}

TEST(CheckMesh, WantsCavitiesTurnedInward) {
  const MeshReport outward = check_mesh(joined({cube(2), cube(1)}));
  EXPECT_FALSE(outward.oriented);
  ASSERT_EQ(count(outward, "inverted shell"), 1u);
  EXPECT_THAT(find(outward, "inverted shell")->places[0], HasSubstr("cavity of 12 faces"));

  const MeshReport island = check_mesh(joined({cube(3), flipped(cube(2)), flipped(cube(1))}));
  EXPECT_FALSE(island.oriented);
  EXPECT_EQ(count(island, "inverted shell"), 1u);
}

TEST(CheckMesh, SaysWhereABoxIsOpen) {
  const MeshReport report = check_mesh(open_box());
  EXPECT_TRUE(report.manifold);
  EXPECT_TRUE(report.oriented);
  ASSERT_EQ(count(report, "open edge"), 4u);
  EXPECT_EQ(find(report, "open edge")->places[0], "edge 4-5 at (0, -1, 1)");
  EXPECT_THAT(report.describe(), HasSubstr("open edge: 4 (edge 4-5 at (0, -1, 1); "));
}

TEST(CheckMesh, SeesThatAMoebiusStripHasNoSides) {
  const MeshReport report = check_mesh(moebius_strip(12));
  EXPECT_FALSE(report.closed);
  EXPECT_TRUE(report.manifold);
  EXPECT_FALSE(report.oriented);
  EXPECT_EQ(report.components, 1u);
}

TEST(CheckMesh, FindsTheEdgeThatTwoCubesShare) {
  const MeshReport report = check_mesh(welded(joined({cube(), moved(cube(), Vec3(2, 2, 0))})));
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.manifold);
  ASSERT_EQ(count(report, "non-manifold edge"), 1u);
  EXPECT_THAT(find(report, "non-manifold edge")->places[0], HasSubstr("at (1, 1, 0) (4 faces)"));
  EXPECT_FALSE(report.self_intersecting);
  EXPECT_FALSE(report.is_solid());
}

TEST(CheckMesh, FindsTheVertexThatTwoCubesShare) {
  const MeshReport report = check_mesh(welded(joined({cube(), moved(cube(), Vec3(2, 2, 2))})));
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.manifold);
  ASSERT_EQ(count(report, "non-manifold vertex"), 1u);
  EXPECT_THAT(find(report, "non-manifold vertex")->places[0], HasSubstr("at (1, 1, 1)"));
  EXPECT_FALSE(report.self_intersecting);
}

TEST(CheckMesh, FindsFacesOfZeroArea) {
  TriangleMesh mesh = cube();
  mesh.faces.push_back({0, 1, 1});
  EXPECT_EQ(count(check_mesh(mesh), "face of zero area"), 1u);
  // Collinear although rounding says otherwise: three points on the diagonal.
  mesh.vertices.push_back(Vec3::Constant(0.1));
  mesh.vertices.push_back(Vec3::Constant(0.2));
  mesh.vertices.push_back(Vec3::Constant(0.3));
  mesh.faces.push_back({8, 9, 10});
  const MeshReport report = check_mesh(mesh);
  EXPECT_TRUE(report.degenerate_faces);
  EXPECT_EQ(count(report, "face of zero area"), 2u);
}

TEST(CheckMesh, StopsAtValuesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = cube();
    mesh.vertices[5].y() = bad;
    const MeshReport report = check_mesh(mesh);
    EXPECT_FALSE(report.finite);
    EXPECT_FALSE(report.is_solid());
    EXPECT_THAT(report.describe(), HasSubstr("vertex 5 at (1, "));
  }
}

TEST(CheckMesh, StopsAtIndicesOutOfRange) {
  for (const std::int32_t bad : {-1, 8, std::numeric_limits<std::int32_t>::max()}) {
    TriangleMesh mesh = cube();
    mesh.faces[7][2] = bad;
    const MeshReport report = check_mesh(mesh);
    EXPECT_FALSE(report.finite);
    EXPECT_EQ(count(report, "index out of range"), 1u);
    EXPECT_THAT(report.describe(), HasSubstr("vertex " + std::to_string(bad) + " in face 7"));
  }
}

TEST(CheckMesh, OfNothingIsNoSolid) {
  EXPECT_FALSE(check_mesh({}).is_solid());
  EXPECT_EQ(check_mesh({}).describe(), "no faces: 1");
}

TEST(CheckMesh, FindsAShellWithoutVolume) {
  TriangleMesh flat;
  flat.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  flat.faces = {{0, 1, 2}, {0, 2, 1}};
  const MeshReport report = check_mesh(flat);
  EXPECT_EQ(count(report, "shell without volume"), 1u);
  EXPECT_FALSE(report.is_solid());
}

TEST(CheckMesh, FindsAShellWhoseVolumeNoNumberHolds) {
  for (const double size : {1e104, 1e200}) {
    TriangleMesh mesh = cube();
    for (Vec3& v : mesh.vertices) v *= size;
    const MeshReport report = check_mesh(mesh);
    EXPECT_FALSE(report.is_solid());
    EXPECT_EQ(count(report, "shell of a volume beyond all numbers"), 1u);
    EXPECT_EQ(count(report, "inverted shell"), 0u);
  }
}

TEST(CheckMesh, NamesAtMostTenPlacesButCountsAll) {
  TriangleMesh soup;
  for (int i = 0; i < 30; ++i) {
    soup = joined({soup, moved(tetrahedron(), Vec3(3 * i, 0, 0))});
    soup.faces.pop_back();
  }
  const MeshReport report = check_mesh(soup);
  EXPECT_EQ(count(report, "open edge"), 90u);
  EXPECT_EQ(find(report, "open edge")->places.size(), 10u);
  EXPECT_THAT(report.describe(), HasSubstr("; ...)"));
}

TEST(CheckMesh, SeesThatAMeshIsNotWelded) {
  TriangleMesh soup;
  for (std::size_t f = 0; f < 12; ++f) {
    TriangleMesh face;
    for (int k = 0; k < 3; ++k) face.vertices.push_back(cube().corner(f, k));
    face.faces = {{0, 1, 2}};
    soup = joined({soup, face});
  }
  const MeshReport report = check_mesh(soup);
  EXPECT_EQ(count(report, "open edge"), 36u);
  EXPECT_EQ(count(report, "vertex at the place of another"), 28u);
  EXPECT_FALSE(report.self_intersecting);
}

TEST(RequireSolid, SaysWhatIsWrongWhereAndWhatToDo) {
  EXPECT_NO_THROW(require_solid(cube(), "cube.obj"));
  try {
    require_solid(open_box(), "box.obj");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'box.obj' does not bound a solid"));
    EXPECT_THAT(error.what(), HasSubstr("open edge: 4"));
    EXPECT_THAT(error.what(), HasSubstr("try again"));
  }
}

TEST(RequireSolid, CanLeaveOutTheSlowPart) {
  const TriangleMesh crossing = joined({cube(), moved(cube(), Vec3(0.5, 0.5, 0.5))});
  EXPECT_THROW(require_solid(crossing, "x"), InputError);
  EXPECT_NO_THROW(require_solid(crossing, "x", {.self_intersections = false}));
}

}  // namespace
}  // namespace fracbench
