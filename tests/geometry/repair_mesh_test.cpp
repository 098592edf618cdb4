#include "geometry/repair_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;
using testing::ElementsAre;
using testing::IsEmpty;

/// Every face with vertices of its own.
TriangleMesh exploded(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto first = static_cast<std::int32_t>(result.vertices.size());
    for (int k = 0; k < 3; ++k) result.vertices.push_back(mesh.corner(f, k));
    result.faces.push_back({first, first + 1, first + 2});
  }
  return result;
}

TEST(RepairMesh, LeavesSolidsBitForBit) {
  for (const auto& [name, mesh] : solids()) {
    const RepairedMesh repaired = repair_mesh(mesh);
    EXPECT_THAT(repaired.actions, IsEmpty()) << name;
    EXPECT_EQ(repaired.mesh.vertices, mesh.vertices) << name;
    EXPECT_EQ(repaired.mesh.faces, mesh.faces) << name;
  }
}

TEST(RepairMesh, MakesASolidOfEverySolidWhoseFacesWereTakenApartAndTurnedAtRandom) {
  Random random(9);
  for (const auto& [name, mesh] : solids()) {
    SCOPED_TRACE(name);
    TriangleMesh broken = exploded(mesh);
    for (Face& face : broken.faces) {
      if (random.uniform() < 0.5) std::swap(face[0], face[1]);
    }
    broken.faces.push_back(broken.faces[1]);
    broken.faces.push_back({4, 4, 5});
    broken.vertices.push_back(Vec3(77, 0, 0));
    const RepairedMesh repaired = repair_mesh(broken);
    const MeshReport report = check_mesh(repaired.mesh);
    EXPECT_TRUE(report.is_solid()) << report.describe();
    EXPECT_EQ(repaired.mesh.vertices.size(), mesh.vertices.size());
    EXPECT_EQ(repaired.mesh.faces.size(), mesh.faces.size());
    EXPECT_NEAR(report.volume / volume(mesh), 1, 1e-12);
    EXPECT_EQ(repaired.actions.size(), 5u);
  }
}

TEST(RepairMesh, IsDoneAfterOneTime) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    TriangleMesh mesh;
    for (int v = 0; v < 20; ++v) {
      mesh.vertices.emplace_back(static_cast<double>(random.below(3)),
                                 static_cast<double>(random.below(3)),
                                 static_cast<double>(random.below(3)));
    }
    for (int f = 0; f < 30; ++f) {
      Face face;
      for (auto& v : face) v = static_cast<std::int32_t>(random.below(20));
      mesh.faces.push_back(face);
    }
    const TriangleMesh once = repair_mesh(mesh).mesh;
    const RepairedMesh twice = repair_mesh(once);
    EXPECT_EQ(twice.mesh.faces, once.faces) << testing::PrintToString(twice.actions);
    EXPECT_EQ(twice.mesh.vertices, once.vertices);
  }
}

TEST(RepairMesh, SaysWhatItDid) {
  TriangleMesh mesh = cube();
  mesh.faces.push_back({3, 3, 7});
  mesh.faces.push_back({3, 1, 0});
  std::swap(mesh.faces[5][0], mesh.faces[5][1]);
  mesh.vertices.push_back(Vec3::Zero());
  EXPECT_THAT(repair_mesh(mesh).actions,
              ElementsAre("dropped 1 face with a repeated vertex", "dropped 1 duplicate face",
                          "turned 1 face", "dropped 1 unused vertex"));
  EXPECT_THAT(repair_mesh(exploded(tetrahedron())).actions, ElementsAre("welded 8 vertices"));
}

TEST(RepairMesh, TurnsShellsOutwardAndCavitiesInward) {
  const RepairedMesh inverted = repair_mesh(flipped(nested_spheres(4)));
  EXPECT_TRUE(check_mesh(inverted.mesh).is_solid());
  EXPECT_NEAR(volume(inverted.mesh), volume(nested_spheres(4)), 1e-10);
  EXPECT_TRUE(check_mesh(repair_mesh(joined({cube(2), cube(1)})).mesh).is_solid());
}

TEST(RepairMesh, DoesNotJoinSolidsThatTouch) {
  for (const Vec3& place : {Vec3(2, 2, 2), Vec3(2, 2, 0), Vec3(2, 0, 0)}) {
    const TriangleMesh two = joined({cube(), moved(cube(), place)});
    EXPECT_THAT(repair_mesh(two).actions, IsEmpty());
  }
}

TEST(RepairMesh, DoesNotMakeEdgesNonManifold) {
  const RepairedMesh repaired =
      repair_mesh(exploded(joined({cube(), moved(cube(), Vec3(2, 2, 0))})));
  for (const auto& finding : check_mesh(repaired.mesh).findings) {
    EXPECT_NE(finding.kind, "non-manifold edge");
  }
}

TEST(RepairMesh, LeavesHolesTwistsAndBadIndicesAlone) {
  EXPECT_THAT(repair_mesh(open_box()).actions, IsEmpty());
  EXPECT_THAT(repair_mesh(moebius_strip(9)).actions, IsEmpty());
  TriangleMesh bad = cube();
  bad.faces[0][0] = 100;
  EXPECT_THAT(repair_mesh(bad).actions, IsEmpty());
  EXPECT_THAT(repair_mesh({}).actions, IsEmpty());
}

}  // namespace
}  // namespace fracbench
