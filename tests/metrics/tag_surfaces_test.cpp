#include "geometry/tag_surfaces.h"

#include <gtest/gtest.h>

#include <set>

#include "core/random.h"
#include "metrics/fracture_normals.h"
#include "metrics/roughness.h"
#include "metrics/surface_retention.h"
#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

std::vector<TriangleMesh> untagged(const Fragments& fragments) {
  std::vector<TriangleMesh> meshes;
  for (const Fragment& fragment : fragments) meshes.push_back(fragment.mesh);
  return meshes;
}

TEST(TagFragments, finds_the_tags_that_the_cutter_knew) {
  Random random(2);
  for (int round = 0; round < 10; ++round) {
    const TriangleMesh body = box({-1, 0, 0}, {1, 1.5, 0.8});
    const Fragments known = cut_all(body, {0.1, 0.7, 0.3}, std::vector<Vec3>{random.unit_vector()});
    const Fragments found = tag_fragments(body, untagged(known));
    ASSERT_EQ(found.size(), known.size());
    for (std::size_t i = 0; i < known.size(); ++i) {
      EXPECT_EQ(found[i].faces, known[i].faces);
      EXPECT_EQ(found[i].mesh.faces, known[i].mesh.faces);
      EXPECT_EQ(found[i].piece, static_cast<std::int32_t>(i));
    }
  }
}

TEST(TagFragments, metrics_of_found_tags_are_those_of_known_ones) {
  const TriangleMesh body = box();
  const std::vector<Vec3> normals{{1, 0.3, 0.2}, {-0.4, 1, 0.1}, {0, 0.2, 1}};
  const Fragments known = cut_all(body, {0.4, 0.5, 0.55}, normals);
  // With six digits, as many programs write them.
  std::vector<TriangleMesh> meshes = untagged(known);
  for (TriangleMesh& mesh : meshes) {
    for (Vec3& v : mesh.vertices) v = (v * 1e6).array().round() / 1e6;
  }
  for (const int threads : {1, 3}) {
    const Fragments found = tag_fragments(body, meshes, {.threads = threads});
    EXPECT_NEAR(value(FractureNormals().measure(cell(body, found)), "fracture_area"),
                value(FractureNormals().measure(cell(body, known)), "fracture_area"), 1e-4);
    EXPECT_NEAR(value(SurfaceRetention().measure(cell(body, found)), "surface_retention"), 1, 1e-4);
    EXPECT_LT(value(Roughness().measure(cell(body, found)), "roughness"), 0.01);
    // Each fragment of the eight meets three others.
    EXPECT_EQ(value(Roughness().measure(cell(body, found)), "interface_count"), 12);
  }
}

TEST(TagFragments, both_sides_of_a_crack_carry_its_number_even_across_a_gap) {
  const TriangleMesh body = box();
  const auto [left, right] = cut(whole(body), {0.5, 0, 0}, {1, 0, 0}, 0);
  const auto [low, high] = cut(right, {0.51, 0, 0}, {1, 0, 0}, 1);
  const Fragments found = tag_fragments(body, {left.mesh, high.mesh});
  std::set<std::int32_t> interfaces;
  for (const Fragment& fragment : found) {
    for (const FragmentFace& face : fragment.faces) {
      if (face.is_fracture()) interfaces.insert(face.interface);
    }
  }
  EXPECT_EQ(interfaces, std::set<std::int32_t>{0});
  // Beyond reach there is no other side.
  const Fragments alone = tag_fragments(body, {left.mesh, high.mesh}, {.interface_reach = 0.005});
  for (const FragmentFace& face : alone[0].faces) EXPECT_EQ(face.interface, -1);
}

TEST(TagFragments, a_chord_below_a_shallow_ridge_is_fracture_surface) {
  // Its corners are on the body's surface, and its normal is near that of both flanks.
  const std::vector<Column> ridge{{0, 0, 1}, {0.5, 0, 1.1}, {1, 0, 1}};
  const std::vector<Column> flat{{0, 0, 1}, {1, 0, 1}};
  const TriangleMesh body = slab(ridge, -1, -1).mesh;
  const Fragment planed = slab(flat, -1, 7);
  const Fragments found = tag_fragments(body, {planed.mesh});
  for (std::size_t f = 0; f < planed.faces.size(); ++f) {
    EXPECT_EQ(found[0].faces[f].is_fracture(), planed.faces[f].interface == 7) << f;
  }
}

TEST(TagFragments, surface_off_the_body_or_turned_round_is_fracture_surface) {
  const TriangleMesh body = box();
  TriangleMesh shrunk = body;
  for (Vec3& v : shrunk.vertices) v = Vec3::Constant(0.5) + 0.999 * (v - Vec3::Constant(0.5));
  TriangleMesh flipped = body;
  for (Face& face : flipped.faces) std::swap(face[0], face[1]);
  for (const TriangleMesh& mesh : {shrunk, flipped}) {
    const Fragments found = tag_fragments(body, {mesh});
    for (const FragmentFace& face : found[0].faces) EXPECT_TRUE(face.is_fracture());
  }
  EXPECT_TRUE(tag_fragments(body, {}).empty());
}

}  // namespace
}  // namespace fracbench
