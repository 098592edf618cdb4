#include "methods/deepfracture/reconstruct.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random.h"
#include "geometry/check_mesh.h"
#include "geometry/gs_sdf.h"
#include "geometry/measures.h"
#include "geometry/remesh.h"
#include "geometry/signed_distance_grid.h"
#include "methods/deepfracture/patterns.h"
#include "methods/deepfracture/round_trip.h"
#include "methods/deepfracture/settings.h"
#include "tests/methods/learned_boxes.h"

namespace fracbench::deepfracture {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ReconstructTest : public testing::Test {
 protected:
  VoxelGrid<float> field(double x, int r) const {
    return gs_sdf(signed_distance_grid(body.mesh, unit_grid<float>(r)),
                  learned_boxes::example(x).fragments);
  }
  static double volume_of(const std::vector<Piece>& pieces) {
    double sum = 0;
    for (const Piece& piece : pieces) sum += volume(piece.mesh);
    return sum;
  }
  static std::size_t fracture_faces(const std::vector<Piece>& pieces) {
    std::size_t count = 0;
    for (const Piece& piece : pieces) {
      for (const PieceFace& face : piece.faces) count += face.is_fracture();
    }
    return count;
  }

  const Target body = learned_boxes::body();
  const double whole = volume(body.mesh);
  learned_boxes::QuietContext context;
};

TEST_F(ReconstructTest, ThePiecesOfAnExactFieldFillTheBodyAndAreCutWhereItSays) {
  for (const int r : {32, 64}) {
    for (const double x : {-0.5, 0.04, 0.61}) {
      const std::vector<Piece> pieces = reconstruct(body.mesh, field(x, r), {}, context.get());
      ASSERT_EQ(pieces.size(), 2u) << r << " " << x;
      EXPECT_NEAR(volume_of(pieces), whole, 1e-12);
      // Both cuts, that of the example and this one, lie between two layers of voxels.
      const double left = std::min(volume(pieces[0].mesh), volume(pieces[1].mesh)) / whole * 1.9;
      EXPECT_NEAR(left, std::min(x + 0.95, 0.95 - x), 2.0 / 32 + 2.0 / r) << r << " " << x;
      for (const Piece& piece : pieces) {
        EXPECT_TRUE(check_mesh(piece.mesh).is_solid());
        EXPECT_EQ(piece.next, nullptr);
      }
    }
  }
}

TEST_F(ReconstructTest, SurfacesAsCoarseAsTheBodysOwnStillFillIt) {
  // Edges of the exterior four to five times as long as a voxel.
  const TriangleMesh exterior = remesh(body.mesh, "box", {.triangles = 800}).mesh;
  const VoxelGrid<float> fine = field(0.2, 64);
  const auto pieces = reconstruct(exterior, fine, {}, context.get());
  const auto coarse = reconstruct(exterior, fine, {.as_coarse_as_surface = true}, context.get());
  ASSERT_EQ(coarse.size(), 2u);
  EXPECT_LT(10 * fracture_faces(coarse), fracture_faces(pieces));
  EXPECT_NEAR(volume_of(coarse), volume(exterior), 1e-12);
}

TEST_F(ReconstructTest, ParityLosesMaterialBetweenTheFragmentsAndNowhereElse) {
  const VoxelGrid<float> exact = field(0.2, 64);
  const auto pieces =
      reconstruct(body.mesh, exact, {.segmentation = {.parity = true}}, context.get());
  ASSERT_EQ(pieces.size(), 2u);
  // A dam of one to two voxels across the box.
  const double lost = whole - volume_of(pieces);
  const double layer = whole / 1.9 * exact.spacing;
  EXPECT_GT(lost, 0.5 * layer);
  EXPECT_LT(lost, 2.5 * layer);
  for (const Piece& piece : pieces) EXPECT_TRUE(check_mesh(piece.mesh).is_solid());
}

TEST_F(ReconstructTest, ComponentsOfFewFacesAreDroppedUnderParity) {
  const VoxelGrid<float> exact = field(0.2, 32);
  EXPECT_THROW(
      reconstruct(body.mesh, exact, {.segmentation = {.parity = true}, .minimum_faces = 100000},
                  context.get()),
      MethodFailure);
  EXPECT_EQ(minimum_faces(64), 50);
  EXPECT_EQ(minimum_faces(128), 200);
  EXPECT_EQ(minimum_faces(256), 400);
}

TEST_F(ReconstructTest, AFieldWithoutInsideIsAFailureOfTheMethod) {
  EXPECT_THROW(reconstruct(body.mesh, unit_grid<float>(16, -1.0f), {}, context.get()),
               MethodFailure);
  EXPECT_THROW(reconstruct(body.mesh, unit_grid<float>(16, NAN), {}, context.get()), MethodFailure);
}

// Rigid bodies of all of them would overlap each other, which takes hours.
TEST_F(ReconstructTest, AFieldOfNoiseIsAFailureThatSaysHowManyFragmentsItFallsInto) {
  Random random(3);
  VoxelGrid<float> noise = unit_grid<float>(32);
  for (float& value : noise.values) value = static_cast<float>(random.uniform(-0.2, 1));
  try {
    reconstruct(body.mesh, noise, {.most_fragments = 30}, context.get());
    FAIL();
  } catch (const MethodFailure& failure) {
    EXPECT_THAT(failure.what(), AllOf(HasSubstr(" fragments, more than most_fragments = 30"),
                                      HasSubstr("more epochs")));
  }
  EXPECT_GT(reconstruct(body.mesh, noise, {}, context.get()).size(), 30u);
}

TEST_F(ReconstructTest, TheLabelsOfExactFieldsAgreeWithTheirFragmentsAndNoOthers) {
  LearningData learning = learned_boxes::learning_data(3);
  Settings settings;
  settings.network.resolutions = {32, 64};
  const neural::DataSet data = make_data_set(body, learning, settings, context.get());
  for (const int r : {32, 64}) {
    for (const double index : round_trip(learning, data, r, {}, context.get())) {
      EXPECT_GT(index, 0.85) << r;  // cuts that lie one layer of voxels off
      EXPECT_LE(index, 1) << r;
    }
  }
  std::swap(learning.examples[0], learning.examples[2]);
  EXPECT_LT(round_trip(learning, data, 64, {}, context.get())[0], 0.5);
}

}  // namespace
}  // namespace fracbench::deepfracture
