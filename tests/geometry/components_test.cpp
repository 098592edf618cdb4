#include "geometry/components.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"
#include "geometry/measures.h"
#include "geometry/shell_nesting.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;

std::size_t component_count(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (const std::int32_t c : face_components(mesh)) count = std::max<std::size_t>(count, c + 1);
  return count;
}

TEST(FaceComponents, AreNumberedInTheOrderOfTheirFirstFace) {
  TriangleMesh mesh = joined({cube(), moved(cube(), Vec3(5, 0, 0))});
  std::swap(mesh.faces[1], mesh.faces[13]);
  const std::vector<std::int32_t> component = face_components(mesh);
  EXPECT_EQ(component[0], 0);
  EXPECT_EQ(component[1], 1);
  EXPECT_EQ(component[13], 0);
  EXPECT_EQ(std::accumulate(component.begin(), component.end(), 0), 12);
}

TEST(FaceComponents, ConnectOverEdgesButNotOverVertices) {
  EXPECT_EQ(component_count(torus(10, 6)), 1u);
  EXPECT_EQ(component_count(moebius_strip(10)), 1u);
  EXPECT_EQ(component_count(welded(joined({cube(), moved(cube(), Vec3(2, 2, 2))}))), 2u);
  EXPECT_EQ(component_count(welded(joined({cube(), moved(cube(), Vec3(2, 2, 0))}))), 1u);
  EXPECT_EQ(component_count({}), 0u);
}

TEST(ExtractFaces, KeepsTheOrderOfFacesAndVertices) {
  const TriangleMesh mesh = sphere(6, 8);
  Random random(5);
  std::vector<std::uint8_t> selected(mesh.faces.size());
  for (auto& s : selected) s = random.uniform() < 0.3;
  const MeshPart part = extract_faces(mesh, selected);
  ASSERT_EQ(part.source_face.size(), part.mesh.faces.size());
  EXPECT_TRUE(std::is_sorted(part.source_face.begin(), part.source_face.end()));
  EXPECT_EQ(static_cast<std::size_t>(std::count(selected.begin(), selected.end(), 1)),
            part.mesh.faces.size());
  for (std::size_t f = 0; f < part.mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(part.mesh.corner(f, k), mesh.corner(part.source_face[f], k));
    }
  }
  // In the order of the mesh, each used one once.
  std::size_t next = 0;
  for (const Vec3& v : mesh.vertices) {
    if (next < part.mesh.vertices.size() && part.mesh.vertices[next] == v) ++next;
  }
  EXPECT_EQ(next, part.mesh.vertices.size());
}

TEST(ExtractFaces, OfNothingIsEmpty) {
  const MeshPart part = extract_faces(cube(), std::vector<std::uint8_t>(12, 0));
  EXPECT_TRUE(part.mesh.vertices.empty());
  EXPECT_TRUE(part.mesh.faces.empty());
}

TEST(SolidComponents, HavePositiveVolumesThatAddUpToTheWhole) {
  for (const auto& [name, mesh] : solids()) {
    SCOPED_TRACE(name);
    double sum = 0;
    std::vector<int> seen(mesh.faces.size(), 0);
    for (const MeshPart& part : solid_components(mesh)) {
      EXPECT_GT(volume(part.mesh), 0);
      sum += volume(part.mesh);
      for (const std::int32_t f : part.source_face) ++seen[f];
    }
    EXPECT_NEAR(sum, volume(mesh), 1e-13 * volume(mesh));
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<long>(seen.size()));
  }
}

TEST(SolidComponents, KeepACavityWithItsSolid) {
  const std::vector<MeshPart> parts = solid_components(hollow_cube());
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_DOUBLE_EQ(volume(parts[0].mesh), 7);
  EXPECT_EQ(parts[0].mesh.faces.size(), 24u);
}

TEST(SolidComponents, PutEachCavityWithTheShellThatEnclosesItDirectly) {
  // Radii 1 to 5: solid 5 with cavity 4, in it solid 3 with cavity 2, in it solid 1.
  const std::vector<MeshPart> parts = solid_components(nested_spheres(5));
  ASSERT_EQ(parts.size(), 3u);
  const double ball = volume(sphere(8, 12));
  EXPECT_NEAR(volume(parts[0].mesh), ball, 1e-12);
  EXPECT_NEAR(volume(parts[1].mesh), (27 - 8) * ball, 1e-12);
  EXPECT_NEAR(volume(parts[2].mesh), (125 - 64) * ball, 1e-12);
}

TEST(SolidComponents, DoNotDependOnTheOrderOfTheShells) {
  const TriangleMesh outer = cube(10), cavity = flipped(cube(4));
  const TriangleMesh left = moved(cavity, Vec3(-2.5, 0, 0)), right = moved(cavity, Vec3(2.5, 0, 0));
  const TriangleMesh core = moved(cube(1), Vec3(2.5, 0, 0));
  for (const TriangleMesh& mesh :
       {joined({outer, left, right, core}), joined({core, right, left, outer})}) {
    std::vector<double> volumes;
    for (const MeshPart& part : solid_components(mesh)) volumes.push_back(volume(part.mesh));
    std::sort(volumes.begin(), volumes.end());
    ASSERT_EQ(volumes.size(), 2u);
    EXPECT_NEAR(volumes[0], 1, 1e-12);
    EXPECT_NEAR(volumes[1], 1000 - 128, 1e-10);
  }
}

TEST(SolidComponents, OfACavityThatTouchesTheOutsideInAVertexStayTogether) {
  // The cavity's corners (2, 2, 2) and the like lie on the outer faces and edges.
  const TriangleMesh outer = box(Vec3(0, 0, 0), Vec3(2, 2, 2));
  TriangleMesh cavity = flipped(tetrahedron());
  for (Vec3& v : cavity.vertices) v = Vec3(2, 2, 2) - v;
  cavity = flipped(cavity);  // the reflection turned it
  const auto parts = solid_components(joined({cavity, outer}));
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(volume(parts[0].mesh), 8 - 1.0 / 6, 1e-14);
}

TEST(ShellNesting, IsRightForShellsThatTouchAtEveryVertex) {
  // An octahedron in a cube with its corners in the middles of the sides, and the other way round
  // a cube with its corners on the sides of an octahedron.
  const auto octahedron = [](double radius) {
    TriangleMesh mesh;
    for (int i = 0; i < 3; ++i) {
      mesh.vertices.push_back(radius * Vec3::Unit(i));
      mesh.vertices.push_back(-radius * Vec3::Unit(i));
    }
    for (int i = 0; i < 8; ++i) {
      const Face face = {i & 1 ? 1 : 0, i & 2 ? 3 : 2, i & 4 ? 5 : 4};
      const bool even = ((i & 1) + (i >> 1 & 1) + (i >> 2 & 1)) % 2 == 0;
      mesh.faces.push_back(even ? face : Face{face[0], face[2], face[1]});
    }
    return mesh;
  };
  EXPECT_NEAR(volume(octahedron(1)), 4.0 / 3, 1e-15);
  for (const auto& mesh : {joined({cube(2), octahedron(1)}), joined({octahedron(3), cube(2)})}) {
    // Both ways round, since a ray that starts on a surface may leave or enter there.
    for (const double sign : {1.0, -1.0}) {
      const TriangleMesh turned = mapped(mesh, [&](const Vec3& v) { return Vec3(sign * v); });
      const ShellNesting nesting = shell_nesting(turned, face_components(turned));
      ASSERT_EQ(nesting.shells.size(), 2u);
      EXPECT_EQ(nesting.shells[0].depth, 0);
      EXPECT_EQ(nesting.shells[1].depth, 1);
      EXPECT_EQ(nesting.shells[1].parent, 0);
    }
  }
}

TEST(ShellNesting, SeesManyShellsInManyShells) {
  // A row of boxes in boxes in boxes.
  std::vector<TriangleMesh> boxes;
  for (int i = 0; i < 20; ++i) {
    for (int depth = 0; depth < 4; ++depth) {
      boxes.push_back(moved(cube(4 - depth), Vec3(5 * i, 0, 0)));
    }
  }
  const TriangleMesh mesh = joined(boxes);
  const ShellNesting nesting = shell_nesting(mesh, face_components(mesh));
  ASSERT_EQ(nesting.shells.size(), 80u);
  for (int s = 0; s < 80; ++s) {
    EXPECT_EQ(nesting.shells[s].depth, s % 4);
    EXPECT_EQ(nesting.shells[s].parent, s % 4 == 0 ? -1 : s - 1);
    EXPECT_DOUBLE_EQ(nesting.shells[s].volume, std::pow(4 - s % 4, 3));
  }
}

}  // namespace
}  // namespace fracbench
