#include "geometry/remesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/isosurface.h"
#include "geometry/measures.h"
#include "geometry/remesh/isotropic_remesh.h"
#include "geometry/signed_distance_grid.h"
#include "geometry/surface_distance.h"

namespace fracbench {
namespace {

constexpr int kFewest = 64;
constexpr double kCountTolerance = 0.1;
constexpr double kCountGoal = 0.03;  // near enough to stop trying other lengths
constexpr int kLengthTries = 4;
// Remeshing to one length gives about this much more than the equilateral triangles of that length.
constexpr double kFirstLength = 1.06;
constexpr double kVolumeTolerance = 0.04;
constexpr double kFiner[] = {4, 8, 16};  // times the triangles, before edges are collapsed
constexpr double kMostFine = 60000;
constexpr double kLooseVolumeTolerance = 0.1;
constexpr double kIsosurfaceSpacing = 0.4;  // of an edge
constexpr int kMostAdvised = 6000;
constexpr double kMostSamples = 2e7;

double length_for(const TriangleMesh& mesh, double triangles) {
  return std::sqrt(4 * area(mesh) / (std::sqrt(3.0) * triangles));
}

double count_error(const TriangleMesh& mesh, int triangles) {
  return static_cast<double>(mesh.faces.size()) / triangles - 1;
}

class Remesher {
 public:
  Remesher(const TriangleMesh& mesh, int triangles, const RemeshOptions& options)
      : options_(options), triangles_(triangles), volume_(volume(mesh)), shells_(shells(mesh)) {}

  /// The first of the ways from `start` whose result is good.
  std::optional<RemeshResult> from(const TriangleMesh& start, double volume_tolerance) {
    if (auto result = isotropic(start); result && good(*result, volume_tolerance)) {
      return RemeshResult{.mesh = std::move(*result), .path = RemeshPath::isotropic};
    }
    const auto collapsed = [&](const TriangleMesh& fine, CollapseOrder order) {
      stop_if_asked();
      auto result = collapse_edges(fine, triangles_, order);
      return result && good(*result, volume_tolerance) ? std::move(result) : std::nullopt;
    };
    for (const CollapseOrder order : {CollapseOrder::shortest_first, CollapseOrder::least_change}) {
      const RemeshPath path =
          order == CollapseOrder::shortest_first ? RemeshPath::collapsed : RemeshPath::simplified;
      for (const double finer : kFiner) {
        if (finer * triangles_ > kMostFine || (options_.quick && finer > kFiner[0])) break;
        stop_if_asked();
        const auto fine =
            isotropic_remesh(start, length_for(start, finer * triangles_), options_.feature_angle);
        if (!fine) continue;
        if (auto result = collapsed(*fine, order)) {
          return RemeshResult{.mesh = *std::move(result), .path = path};
        }
      }
      if (auto result = collapsed(start, order)) {
        return RemeshResult{.mesh = *std::move(result), .path = path};
      }
      if (options_.quick) break;
    }
    return std::nullopt;
  }

  std::optional<RemeshResult> from_surface(const TriangleMesh& mesh) {
    auto result = from(mesh, options_.quick ? kLooseVolumeTolerance : kVolumeTolerance);
    return result || options_.quick ? std::move(result) : from(mesh, kLooseVolumeTolerance);
  }

  const std::string& reason() const { return reason_; }

 private:
  void stop_if_asked() const {
    if (options_.stop.stop_requested()) throw Cancelled();
  }

  std::size_t shells(const TriangleMesh& mesh) const {
    return check_mesh(mesh, {.self_intersections = false, .threads = options_.threads}).components;
  }

  /// Remeshes with lengths that come nearer to the wanted count.
  std::optional<TriangleMesh> isotropic(const TriangleMesh& start) const {
    double length = kFirstLength * length_for(start, triangles_);
    std::optional<TriangleMesh> best;
    for (int n = 0; n < kLengthTries; ++n) {
      stop_if_asked();
      auto next = isotropic_remesh(start, length, options_.feature_angle);
      if (!next || next->faces.empty()) break;
      const double error = count_error(*next, triangles_);
      if (!best || std::abs(error) < std::abs(count_error(*best, triangles_))) {
        best = std::move(next);
      }
      if (std::abs(error) < kCountGoal) break;
      length *= std::sqrt(1 + error);
    }
    return best;
  }

  bool good(const TriangleMesh& result, double volume_tolerance) {
    const double error = count_error(result, triangles_);
    if (std::abs(error) > kCountTolerance) {
      reason_ = fmt::format("it comes out with {} triangles", result.faces.size());
      return false;
    }
    const double change = volume(result) / volume_ - 1;
    if (std::abs(change) > volume_tolerance) {
      reason_ = fmt::format("its volume changes by {:.1f} %", 100 * change);
      return false;
    }
    const MeshReport report = check_mesh(result, {.threads = options_.threads});
    if (!report.is_solid()) {
      reason_ = "the new surface is not a solid";
      for (const auto& finding : report.findings) {
        reason_ += fmt::format(", {} x {}", finding.count, finding.kind);
      }
      return false;
    }
    // A cavity finer than the triangles may close where the isosurface is allowed to lose it too.
    if (report.components != shells_ &&
        !(options_.allow_isosurface && report.components < shells_)) {
      reason_ = fmt::format("{} shells become {}", shells_, report.components);
      return false;
    }
    return true;
  }

  const RemeshOptions& options_;
  int triangles_;
  double volume_;
  std::size_t shells_;
  std::string reason_;
};

TriangleMesh isosurface_of(const TriangleMesh& mesh, double spacing, int threads) {
  const BoundingBox box = bounding_box(mesh);
  const Vec3 extent = box.high - box.low;
  spacing = std::max(spacing, std::cbrt(extent.prod() / kMostSamples));
  std::array<std::int32_t, 3> size{};
  for (int a = 0; a < 3; ++a) size[a] = static_cast<std::int32_t>(extent[a] / spacing) + 5;
  const Vec3 middle(0.5 * (size[0] - 1), 0.5 * (size[1] - 1), 0.5 * (size[2] - 1));
  VoxelGrid<float> grid(size, box.center() - spacing * middle, spacing);
  return isosurface(signed_distance_grid(mesh, std::move(grid), threads));
}

/// The farthest vertex or face centre of `from` from the surface `to`.
double farthest(const TriangleMesh& from, const SurfaceDistance& to) {
  double result = 0;
  for (const Vec3& v : from.vertices) result = std::max(result, to.nearest(v).distance);
  for (std::size_t f = 0; f < from.faces.size(); ++f) {
    const Vec3 center = (from.corner(f, 0) + from.corner(f, 1) + from.corner(f, 2)) / 3;
    result = std::max(result, to.nearest(center).distance);
  }
  return result;
}

}  // namespace

RemeshResult remesh(const TriangleMesh& mesh, std::string_view name, const RemeshOptions& options) {
  if (options.triangles < kFewest) {
    throw InputError(fmt::format("{}: a mesh of {} triangles is wanted; at least {} are needed",
                                 name, options.triangles, kFewest));
  }
  Remesher remesher(mesh, options.triangles, options);
  std::optional<RemeshResult> result = remesher.from_surface(mesh);
  if (!result && options.allow_isosurface) {
    const double spacing = kIsosurfaceSpacing * length_for(mesh, options.triangles);
    result = remesher.from(isosurface_of(mesh, spacing, options.threads), kLooseVolumeTolerance);
    if (result) result->path = RemeshPath::isosurface;
  }
  if (!result) {
    std::string advice = "thicken the shape, or make its surface simpler";
    for (int triangles = 2 * options.triangles; triangles <= kMostAdvised; triangles *= 2) {
      if (options.quick) break;
      if (!Remesher(mesh, triangles, options).from_surface(mesh)) continue;
      advice = fmt::format("use {} triangles", triangles);
      break;
    }
    throw InputError(fmt::format("{}: cannot be remeshed to {} triangles: {}; {}", name,
                                 options.triangles, remesher.reason(), advice));
  }
  const double before = volume(mesh);
  result->volume_change = volume(result->mesh) / before - 1;
  result->edge_length = length_for(result->mesh, static_cast<double>(result->mesh.faces.size()));
  result->hausdorff = std::max(farthest(result->mesh, SurfaceDistance(mesh)),
                               farthest(mesh, SurfaceDistance(result->mesh)));
  return *std::move(result);
}

}  // namespace fracbench
