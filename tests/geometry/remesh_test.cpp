#include "geometry/remesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "geometry/surface_distance.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using namespace test_meshes;

/// Standard deviation over mean of the edges' lengths.
double edge_spread(const TriangleMesh& mesh) {
  double sum = 0, squares = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const double length = (mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k)).norm();
      sum += length;
      squares += length * length;
    }
  }
  const double count = 3.0 * static_cast<double>(mesh.faces.size());
  return std::sqrt(std::max(0.0, squares / count - sum * sum / count / count)) / (sum / count);
}

void expect_remeshed(const std::string& name, const TriangleMesh& mesh, int triangles) {
  SCOPED_TRACE(name);
  const RemeshResult result = remesh(mesh, name, {.triangles = triangles});
  const MeshReport before = check_mesh(mesh), after = check_mesh(result.mesh);
  EXPECT_TRUE(after.is_solid()) << after.describe();
  EXPECT_EQ(after.components, before.components);
  EXPECT_NEAR(static_cast<double>(result.mesh.faces.size()) / triangles, 1, 0.1);
  EXPECT_NEAR(result.volume_change, after.volume / before.volume - 1, 1e-12);
  EXPECT_LT(std::abs(result.volume_change), 0.1);
  const double spread = edge_spread(result.mesh);
  EXPECT_LT(spread, result.path == RemeshPath::simplified ? 1.5 : 0.45);
  std::printf(
      "%-16s %5zu -> %4zu triangles, path %d, edge %.3f m (spread %.2f), volume %+.2f %%, "
      "Hausdorff %.3f m\n",
      name.c_str(), mesh.faces.size(), result.mesh.faces.size(), static_cast<int>(result.path),
      result.edge_length, spread, 100 * result.volume_change, result.hausdorff);
}

TEST(Remesh, GivesSolidsOfTheWantedCountForAllSolids) {
  for (const Named& solid : solids()) expect_remeshed(solid.name, solid.mesh, 1500);
}

TEST(Remesh, GivesSolidsOfTheWantedCountForTheDevelopmentShapes) {
  bool any = false;
  for (const char* file : {"ball.obj", "base.obj", "bunny.obj", "letter_p.off", "mug.obj",
                           "pot_standin.obj", "spot.obj", "squirrel.obj"}) {
    const auto path = shared_mesh(file);
    if (path.empty()) continue;
    any = true;
    const TriangleMesh mesh = normalized(read_mesh(path), 1.9);
    if (!check_mesh(mesh).is_solid()) continue;
    expect_remeshed(file, mesh, 1500);
    expect_remeshed(file, mesh, 400);
  }
  if (!any) GTEST_SKIP() << "../shared/meshes is not there";
}

TEST(Remesh, KeepsTheEdgesOfACube) {
  const TriangleMesh cube = test_meshes::cube();
  const RemeshResult result = remesh(cube, "cube", {.triangles = 1000});
  EXPECT_NEAR(volume(result.mesh), 8, 1e-12);
  EXPECT_LT(result.hausdorff, 1e-12);
  // An edge is kept where no triangle cuts its corner off: every normal is along an axis.
  for (std::size_t f = 0; f < result.mesh.faces.size(); ++f) {
    EXPECT_NEAR(area_vector2(result.mesh, f).normalized().cwiseAbs().maxCoeff(), 1, 1e-9);
  }
}

TEST(Remesh, ComesNearerToASphereWithMoreTriangles) {
  const TriangleMesh ball = sphere(60, 120);
  const RemeshResult coarse = remesh(ball, "ball", {.triangles = 500});
  const RemeshResult fine = remesh(ball, "ball", {.triangles = 4500});
  // Second order: nine times the triangles, a third of the edge, a ninth of the error.
  EXPECT_LT(fine.hausdorff, coarse.hausdorff / 4);
  EXPECT_LT(std::abs(fine.volume_change), std::abs(coarse.volume_change) / 4);
}

TEST(Remesh, MeasuresTheDistanceFromTheOriginal) {
  const TriangleMesh ball = sphere(60, 120);
  const RemeshResult result = remesh(ball, "ball", {.triangles = 500});
  const SurfaceDistance to_ball(ball);
  for (const Vec3& v : result.mesh.vertices) {
    EXPECT_LE(to_ball.nearest(v).distance, result.hausdorff);
  }
  EXPECT_LT(result.hausdorff, result.edge_length);
}

TEST(Remesh, GivesTheSameMeshAgainAndForAnyNumberOfThreads) {
  const TriangleMesh ring = torus(48, 24);
  const RemeshResult one = remesh(ring, "ring", {.triangles = 800, .threads = 1});
  const RemeshResult two = remesh(ring, "ring", {.triangles = 800, .threads = 2});
  EXPECT_EQ(one.mesh.faces, two.mesh.faces);
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
}

TEST(Remesh, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(remesh(cube(), "cube", {.triangles = 400, .stop = source.get_token()}), Cancelled);
}

TEST(Remesh, SaysWhichCountWouldDoWhereABodyIsTooThin) {
  // A spherical shell of a twentieth of its radius.
  const TriangleMesh shell = joined({sphere(40, 80, 1), flipped(sphere(40, 80, 0.95))});
  try {
    remesh(shell, "shell", {.triangles = 100});
    FAIL() << "no error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("shell: cannot be remeshed to 100 triangles"), std::string::npos) << text;
    const auto at = text.find("use ");
    if (at != std::string::npos) {
      EXPECT_NO_THROW(remesh(shell, "shell", {.triangles = std::stoi(text.substr(at + 4))}))
          << text;
    }
  }
  EXPECT_THROW(remesh(shell, "shell", {.triangles = 10}), InputError);
}

}  // namespace
}  // namespace fracbench
