#include "methods/import/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include "core/collision_folder.h"
#include "core/error.h"
#include "geometry/measures.h"
#include "geometry/pieces_of_fragments.h"
#include "geometry/read_fragments.h"
#include "geometry/tag_surfaces.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

// A scene moves the point to the body's surface, by at most 2 % of its size.
constexpr double kPlaceTolerance = 0.025;  // of the longest side
constexpr double kDirectionTolerance = 1e-6;
constexpr double kMagnitudeTolerance = 1e-9;  // relative
// Fragments of another body, or in another place or scale, are a mistake that is told at once.
constexpr double kBoxTolerance = 0.02;  // of the longest side

class ImportedBody : public Breakable {
 public:
  ImportedBody(const Target& target, std::vector<StoredCollision> collisions)
      : body_(target.mesh), box_(bounding_box(target.mesh)), collisions_(std::move(collisions)) {}

  std::vector<Piece> fracture(const Impact& impact, Context& context) const override {
    const StoredCollision& collision = collision_of(impact);
    std::vector<TriangleMesh> meshes;
    {
      const auto stage = context.timer.stage("reading");
      const std::vector<fs::path> files = mesh_files(collision.folder);
      try {
        // One file with all fragments, or one file each.
        meshes = read_fragment_meshes(files.size() == 1 ? files.front() : collision.folder);
      } catch (const InputError& error) {
        throw MethodFailure(fmt::format("import: {}", error.what()));
      }
    }
    require_place(meshes, collision);
    const auto stage = context.timer.stage("tagging");
    return pieces_of_fragments(
        tag_fragments(body_, std::move(meshes), {.threads = context.threads}));
  }

  void save(const fs::path&) const override {}

 private:
  /// The first with the impulses of the impact.
  const StoredCollision& collision_of(const Impact& impact) const {
    const double size = box_.longest_side();
    for (const StoredCollision& collision : collisions_) {
      if (std::ranges::equal(
              collision.impulses, impact.impulses,
              [&](const GivenImpulse& given, const Impulse& impulse) {
                return (given.point - impulse.point).norm() <= kPlaceTolerance * size &&
                       (given.direction - impulse.direction).norm() <= kDirectionTolerance &&
                       std::abs(given.magnitude - impulse.magnitude) <=
                           kMagnitudeTolerance * given.magnitude;
              })) {
        return collision;
      }
    }
    throw MethodFailure(
        "import: none of the collisions has these impulses; only scenes of the family 'imported' "
        "with the same folder can be answered");
  }

  void require_place(const std::vector<TriangleMesh>& meshes,
                     const StoredCollision& collision) const {
    BoundingBox all = bounding_box(meshes.front());
    for (const TriangleMesh& mesh : meshes) {
      const BoundingBox one = bounding_box(mesh);
      all = {.low = all.low.cwiseMin(one.low), .high = all.high.cwiseMax(one.high)};
    }
    const double off = std::max((all.low - box_.low).cwiseAbs().maxCoeff(),
                                (all.high - box_.high).cwiseAbs().maxCoeff());
    if (off <= kBoxTolerance * box_.longest_side()) return;
    throw MethodFailure(fmt::format(
        "import: the fragments in {} span {:.4g},{:.4g},{:.4g} to {:.4g},{:.4g},{:.4g}, the body "
        "{:.4g},{:.4g},{:.4g} to {:.4g},{:.4g},{:.4g}: they are of another body, or the suite "
        "scales it (longest_side = 0 keeps it as it is)",
        collision.folder.string(), all.low.x(), all.low.y(), all.low.z(), all.high.x(),
        all.high.y(), all.high.z(), box_.low.x(), box_.low.y(), box_.low.z(), box_.high.x(),
        box_.high.y(), box_.high.z()));
  }

  TriangleMesh body_;
  BoundingBox box_;
  std::vector<StoredCollision> collisions_;
};

std::unique_ptr<Breakable> body_of(const Target& target, const Options& options) {
  const std::string& path = options.text("path");
  if (path.empty()) {
    throw InputError(
        "import: where the fragments are is missing: path = \"folder\" (docs/import.md)");
  }
  return std::make_unique<ImportedBody>(target, read_collision_folder(path));
}

}  // namespace

MethodInfo ImportMethod::info() const {
  MethodInfo info;
  info.name = "import";
  info.summary = "fragments that some tool has made, for scenes of the family imported";
  info.shape_type = "unknown";
  info.quick_to_prepare = true;
  info.volume_tolerance = 1e-2;  // modelling programs cut with tolerances of their own
  return info;
}

OptionsSchema ImportMethod::options() const {
  return {{.name = "path",
           .fallback = std::string(),
           .unit = "",
           .summary = "folder with a folder for each collision; what is in it is part of what "
                      "determines a result"}};
}

std::unique_ptr<Breakable> ImportMethod::prepare(const Target& target, const LearningData&,
                                                 const Options& options, Context&) const {
  return body_of(target, options);
}

std::unique_ptr<Breakable> ImportMethod::load(const fs::path&, const Target& target,
                                              const Options& options) const {
  return body_of(target, options);
}

std::vector<fs::path> ImportMethod::files(const Options& options) const {
  std::vector<fs::path> files;
  if (options.text("path").empty()) return files;
  for (const StoredCollision& collision : read_collision_folder(options.text("path"))) {
    std::ranges::copy(collision.files(), std::back_inserter(files));
  }
  return files;
}

}  // namespace fracbench
