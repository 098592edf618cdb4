#include "geometry/surface_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "core/random.h"
#include "geometry/measures.h"
#include "tests/geometry/reference_field.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

/// Points in a box half as large again as the mesh's.
Vec3 random_point_around(const BoundingBox& box, Random& random) {
  const double half = 0.75 * box.longest_side();
  return box.center() +
         half * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

Vec3 random_point_on(const TriangleMesh& mesh, std::size_t face, Random& random) {
  double u = random.uniform(), v = random.uniform();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return (1 - u - v) * mesh.corner(face, 0) + u * mesh.corner(face, 1) + v * mesh.corner(face, 2);
}

TEST(SurfaceDistance, AgreesWithTestingEveryTriangle) {
  for (const auto& [name, mesh] : test_meshes::solids()) {
    Random random(derive_seed(1, {name}));
    const SurfaceDistance surface(mesh);
    const BoundingBox box = bounding_box(mesh);
    const double scale = box.longest_side() + box.center().norm();
    for (int i = 0; i < 300; ++i) {
      const Vec3 query = random_point_around(box, random);
      EXPECT_NEAR(surface.nearest(query).distance, reference::distance(mesh, query), 1e-13 * scale)
          << name;
    }
  }
}

TEST(SurfaceDistance, TheNearestPointIsOnItsFaceAndAtItsDistance) {
  for (const auto& [name, mesh] : test_meshes::solids()) {
    Random random(derive_seed(2, {name}));
    const SurfaceDistance surface(mesh);
    const BoundingBox box = bounding_box(mesh);
    const double tolerance = 1e-13 * (box.longest_side() + box.center().norm());
    for (int i = 0; i < 100; ++i) {
      const Vec3 query = random_point_around(box, random);
      const SurfaceDistance::Nearest nearest = surface.nearest(query);
      ASSERT_GE(nearest.face, 0);
      EXPECT_NEAR((query - nearest.point).norm(), nearest.distance, tolerance) << name;
      TriangleMesh face{mesh.vertices, {mesh.faces[nearest.face]}};
      EXPECT_NEAR(reference::distance(face, nearest.point), 0, tolerance) << name;
    }
  }
}

TEST(SurfaceDistance, InsideAgreesWithTheWindingNumber) {
  for (const auto& [name, mesh] : test_meshes::solids()) {
    Random random(derive_seed(3, {name}));
    const SurfaceDistance surface(mesh);
    const BoundingBox box = bounding_box(mesh);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 query = random_point_around(box, random);
      const double winding = reference::winding_number(mesh, query);
      if (std::abs(winding - std::round(winding)) > 1e-3) continue;  // too near for the sum
      EXPECT_EQ(surface.inside(query), std::round(winding) != 0)
          << name << " at " << query.transpose();
    }
  }
}

TEST(SurfaceDistance, APointBesideTheSurfaceIsOnItsSide) {
  // A millionth of a face away from the surface, on both sides.
  for (const auto& [name, mesh] : test_meshes::solids()) {
    if (name == "plate" || name == "far cube") continue;  // thinner than that; too coarse there
    Random random(derive_seed(4, {name}));
    const SurfaceDistance surface(mesh);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const Vec3 normal = area_vector2(mesh, f);
      const Vec3 step = 1e-9 * normal.normalized() * std::sqrt(normal.norm());
      const Vec3 place = random_point_on(mesh, f, random);
      EXPECT_FALSE(surface.inside(place + step)) << name;
      EXPECT_TRUE(surface.inside(place - step)) << name;
    }
  }
}

TEST(SurfaceDistance, LinesThroughVerticesAndEdgesAreNotMiscounted) {
  // Lines along x through these points run through vertices and edges and within faces.
  const TriangleMesh mesh =
      test_meshes::joined({test_meshes::box(Vec3(0, 0, 0), Vec3(2, 2, 2)),
                           test_meshes::box(Vec3(4, 0, 1), Vec3(6, 2, 3)),
                           test_meshes::moved(test_meshes::sphere(4, 4), Vec3(9, 1, 1))});
  const SurfaceDistance surface(mesh);
  for (double x = -1; x < 12; x += 0.5) {
    for (double y = -1; y <= 4; y += 0.5) {
      for (double z = -1; z <= 4; z += 0.5) {
        const Vec3 query(x, y, z);
        if (surface.nearest(query).distance == 0) continue;
        EXPECT_EQ(surface.inside(query), std::round(reference::winding_number(mesh, query)) != 0)
            << query.transpose();
      }
    }
  }
}

TEST(SurfaceDistance, TheSignIsPositiveInside) {
  const Vec3 low(-1, -2, -0.5), high(1, 1, 3);
  const SurfaceDistance surface(test_meshes::box(low, high));
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 query(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4));
    EXPECT_NEAR(surface.signed_distance(query), reference::box_signed_distance(low, high, query),
                1e-14);
  }
}

TEST(SurfaceDistance, PointsVeryFarAwayStillHaveADistance) {
  const SurfaceDistance surface(test_meshes::cube());
  for (const double far : {1e6, 1e15, 1e30, 1e100}) {
    EXPECT_NEAR(surface.nearest(Vec3(far, 0, 0)).distance, far - 1, 1e-15 * far + 1e-9);
    EXPECT_FALSE(surface.inside(Vec3(-far, 0.1, 0.1)));
  }
}

TEST(SurfaceDistance, NeedlesAndPointsAmongTheFacesDoNoHarm) {
  TriangleMesh mesh = test_meshes::cube();
  const double reference = SurfaceDistance(mesh).nearest(Vec3(3, 0.3, 0.2)).distance;
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {Vec3(0, 0, 0), Vec3(0.1, 0.1, 0.1),
                                             Vec3(0.3, 0.3, 0.3), Vec3(0.2, 0.2, 0.2 + 1e-17)});
  mesh.faces.push_back({first, first, first});
  mesh.faces.push_back({first, first, first + 1});
  mesh.faces.push_back({first, first + 1, first + 2});
  mesh.faces.push_back({first, first + 2, first + 3});
  const SurfaceDistance surface(mesh);
  EXPECT_EQ(surface.nearest(Vec3(3, 0.3, 0.2)).distance, reference);
  EXPECT_NEAR(surface.nearest(Vec3(0.15, 0.15, 0.15)).distance, 0, 1e-16);
  EXPECT_NEAR(surface.nearest(Vec3(0.25, 0.15, 0.2)).distance, std::sqrt(0.005), 1e-15);
}

TEST(SurfaceDistance, RaysHitWhatTheyPointAt) {
  for (const auto& [name, mesh] : test_meshes::solids()) {
    Random random(derive_seed(6, {name}));
    const SurfaceDistance surface(mesh);
    const BoundingBox box = bounding_box(mesh);
    for (int i = 0; i < 200; ++i) {
      const std::size_t face = random.below(mesh.faces.size());
      const Vec3 aim = random_point_on(mesh, face, random);
      const Vec3 origin = random_point_around(box, random);
      const SurfaceDistance::Hit hit = surface.first_hit(origin, aim - origin);
      ASSERT_GE(hit.face, 0) << name;
      EXPECT_GE(hit.t, 0);
      EXPECT_LE(hit.t, 1 + 1e-9);
      // Nothing lies between the origin and the hit.
      const Vec3 point = origin + hit.t * (aim - origin);
      EXPECT_NEAR(surface.nearest(point).distance, 0, 1e-9 * box.longest_side()) << name;
      const Vec3 half = origin + 0.5 * hit.t * (aim - origin);
      EXPECT_EQ(surface.inside(half), surface.inside(origin)) << name;
    }
  }
}

TEST(SurfaceDistance, RaysDoNotSlipThroughVerticesAndEdges) {
  const TriangleMesh mesh = test_meshes::sphere(6, 8);
  const SurfaceDistance surface(mesh);
  for (const Face& face : mesh.faces) {
    for (int k = 0; k < 3; ++k) {
      const Vec3& from = mesh.vertices[face[k]];
      const Vec3& to = mesh.vertices[face[(k + 1) % 3]];
      for (const double t : {0.0, 0.25, 0.5}) {
        EXPECT_GE(
            surface
                .first_hit(Vec3(0.01, 0.02, 0.03), (1 - t) * from + t * to - Vec3(0.01, 0.02, 0.03))
                .face,
            0);
      }
    }
  }
}

TEST(SurfaceDistance, RaysPastTheMeshHitNothing) {
  const SurfaceDistance surface(test_meshes::cube());
  EXPECT_EQ(surface.first_hit(Vec3(3, 0, 0), Vec3(1, 0, 0)).face, -1);
  EXPECT_EQ(surface.first_hit(Vec3(3, 0, 0), Vec3(0, 1, 0)).face, -1);
  EXPECT_EQ(surface.first_hit(Vec3(3, 0, 0), Vec3(0, 0, 0)).face, -1);
  const SurfaceDistance::Hit hit = surface.first_hit(Vec3(3, 0.2, 0), Vec3(-2, 0, 0));
  EXPECT_DOUBLE_EQ(hit.t, 1);
}

TEST(SurfaceDistance, ManyThreadsGetTheAnswersOfOne) {
  const TriangleMesh mesh = test_meshes::torus(40, 20);
  const SurfaceDistance surface(mesh);
  const auto answers = [&] {
    Random random(7);
    std::vector<double> values;
    for (int i = 0; i < 2000; ++i) {
      values.push_back(surface.signed_distance(random_point_around(bounding_box(mesh), random)));
    }
    return values;
  };
  const std::vector<double> expected = answers();
  std::vector<std::vector<double>> got(4);
  std::vector<std::jthread> threads;
  for (auto& result : got) threads.emplace_back([&] { result = answers(); });
  threads.clear();
  for (const auto& result : got) EXPECT_EQ(result, expected);
}

}  // namespace
}  // namespace fracbench
