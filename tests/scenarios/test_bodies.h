#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/breakable.h"
#include "core/context.h"
#include "core/target.h"

namespace fracbench::test {

/// A context of its own, seeded.
struct TestContext {
  Random random{1};
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress};
};

/// A box with 12 faces, centred at `center`.
TriangleMesh box(const Vec3& sides, const Vec3& center = Vec3::Zero());

/// An octahedron divided `levels` times, its vertices on the sphere.
TriangleMesh sphere(double radius, int levels);

/// Every face cut into four; the shape stays the same.
TriangleMesh refined(const TriangleMesh& mesh);

/// The part of a convex solid where normal . x <= offset, with tags: faces of the solid keep their
/// number, the cut has the neighbour -1.
Piece convex_part(const TriangleMesh& convex, const std::vector<PieceFace>& tags,
                  const Vec3& normal, double offset);

/// A convex body that breaks along planes, each of which cuts all pieces there are.
class PlaneSplitter final : public Breakable {
 public:
  struct Cut {
    Vec3 normal = Vec3::UnitX();
    double offset = 0;
  };

  PlaneSplitter(TriangleMesh mesh, std::vector<Cut> cuts, std::vector<Cut> later = {})
      : mesh_(std::move(mesh)), cuts_(std::move(cuts)), later_(std::move(later)) {}

  std::vector<Piece> fracture(const Impact& impact, Context& context) const override;
  void save(const std::filesystem::path&) const override {}

 private:
  TriangleMesh mesh_;
  std::vector<Cut> cuts_;
  std::vector<Cut> later_;  ///< how the pieces break again; empty: they cannot
};

/// The folder of development meshes; empty where it is not there.
std::filesystem::path mesh_folder();

}  // namespace fracbench::test
