#include "methods/modes/cage.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "methods/modes/validation/shapes.h"
#include "source_folder.h"

namespace fracbench::modes {
namespace {

class Cage : public testing::Test {
 protected:
  Context context{.random = random_, .timer = timer_, .progress = progress_};

 private:
  Random random_{1};
  StageTimer timer_;
  Progress progress_;
};

TEST_F(Cage, EnclosesTheShapeWithAsManyFacesAsAskedFor) {
  for (const TriangleMesh& shape : {notched_bar(), l_shape(), plate_with_hole(), dumbbell()}) {
    for (const std::int64_t faces : {800, 2500}) {
      const TriangleMesh cage =
          build_cage(shape, {.kind = CageKind::offset, .target_faces = faces}, context);
      EXPECT_NEAR(static_cast<double>(cage.faces.size()), static_cast<double>(faces),
                  0.1 * static_cast<double>(faces));
      EXPECT_TRUE(check_mesh(cage).is_solid());
      EXPECT_TRUE(encloses(cage, shape));
      EXPECT_LT(volume(cage), 2.5 * volume(shape));
    }
  }
}

TEST_F(Cage, IsTheShapeItselfWhereThatIsSimpleEnough) {
  const TriangleMesh shape = notched_bar();
  EXPECT_EQ(build_cage(shape, {.target_faces = 64}, context).faces, shape.faces);
  EXPECT_NE(build_cage(shape, {.kind = CageKind::offset, .target_faces = 600}, context).faces,
            shape.faces);
}

TEST_F(Cage, HasAShellForEveryPartAndCavity) {
  TriangleMesh shape = plain_bar();
  const auto add = [&](const Vec3& by, double scale, bool turned) {
    const auto shift = static_cast<std::int32_t>(shape.vertices.size());
    const TriangleMesh bar = plain_bar();
    for (const Vec3& v : bar.vertices) shape.vertices.push_back(v * scale + by);
    for (const Face& f : bar.faces) {
      shape.faces.push_back({f[0] + shift, f[turned ? 2 : 1] + shift, f[turned ? 1 : 2] + shift});
    }
  };
  add({0.5, 0.125, 0.125}, 0.75, true);  // a cavity
  add({0, 3, 0}, 1, false);              // another part
  const CageOptions options{.kind = CageKind::offset, .target_faces = 4000};
  const TriangleMesh cage = build_cage(shape, options, context);
  EXPECT_TRUE(encloses(cage, shape));
  EXPECT_EQ(check_mesh(cage).components, 3u);
  const TetMesh mesh = tetrahedralise_cage(shape, options, context);
  EXPECT_NEAR(mesh.volume() * std::pow(mesh.frame.size, 3), volume(cage), 1e-9);
}

TEST_F(Cage, EnclosesTellsCutsAndOutsidesFromInsides) {
  const auto scaled = [](double factor, const Vec3& by) {
    TriangleMesh mesh = plain_bar();
    for (Vec3& v : mesh.vertices) v = (v - Vec3(2, 0.5, 0.5)) * factor + Vec3(2, 0.5, 0.5) + by;
    return mesh;
  };
  const TriangleMesh shape = plain_bar();
  EXPECT_TRUE(encloses(scaled(1.1, Vec3::Zero()), shape));
  EXPECT_FALSE(encloses(scaled(0.9, Vec3::Zero()), shape));
  EXPECT_FALSE(encloses(scaled(1.1, Vec3(0, 0.3, 0)), shape));
  EXPECT_FALSE(encloses(scaled(1.1, Vec3(0, 3, 0)), shape));
}

TEST_F(Cage, IsRefusedWithTheWayOut) {
  EXPECT_THROW(build_cage(plain_bar(), {.target_faces = 3}, context), InputError);
  TriangleMesh open = plain_bar();
  open.faces.pop_back();
  EXPECT_THROW(build_cage(open, {}, context), InputError);
}

TEST_F(Cage, EnclosesTheSquirrelAsInThePaper) {
  const auto file = std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes/squirrel.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const TriangleMesh shape = read_mesh(file);
  const CageOptions options{.target_faces = kPaperCage.cage_faces};
  const TriangleMesh cage = build_cage(shape, options, context);
  EXPECT_TRUE(encloses(cage, shape));
  const TetMesh mesh = tetrahedralise_cage(shape, options, context);
  EXPECT_LT(mesh.tets.size(), 25000u);
}

TEST_F(Cage, HasAboutAsManyTetsAsAskedFor) {
  for (const int tets : {1600, 4000}) {
    const TetMesh mesh = tetrahedralise_cage(l_shape(), {.target_tets = tets}, context);
    EXPECT_NEAR(static_cast<double>(mesh.tets.size()), tets, 0.1 * tets);
    EXPECT_NEAR(mesh.volume(), volume(l_shape()) / 8, 1e-12);
  }
}

}  // namespace
}  // namespace fracbench::modes
