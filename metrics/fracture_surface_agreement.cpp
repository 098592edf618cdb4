#include "metrics/fracture_surface_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <unordered_set>
#include <vector>

#include "geometry/measures.h"
#include "geometry/triangle_tree.h"

namespace fracbench {

namespace {

/// The fracture surface of all fragments: each crack twice, once from either side.
TriangleMesh fracture_surface(const Fragments& fragments) {
  TriangleMesh surface;
  for (const Fragment& fragment : fragments) {
    const auto first = static_cast<std::int32_t>(surface.vertices.size());
    bool any = false;
    for (std::size_t f = 0; f < fragment.mesh.faces.size(); ++f) {
      if (!fragment.faces[f].is_fracture()) continue;
      any = true;
      Face face = fragment.mesh.faces[f];
      for (std::int32_t& v : face) v += first;
      surface.faces.push_back(face);
    }
    if (any) {
      surface.vertices.insert(surface.vertices.end(), fragment.mesh.vertices.begin(),
                              fragment.mesh.vertices.end());
    }
  }
  return surface;
}

/// The same surface with one face in place of several that have the same corners: where both sides
/// of a crack are divided alike it has each face twice.
TriangleMesh without_twins(const TriangleMesh& mesh) {
  using Corners = std::array<std::array<double, 3>, 3>;
  struct Hash {
    std::size_t operator()(const Corners& corners) const {
      std::size_t hash = 0;
      for (const auto& corner : corners) {
        for (const double x : corner) hash = hash * 0x9e3779b97f4a7c15u + std::hash<double>()(x);
      }
      return hash;
    }
  };
  std::unordered_set<Corners, Hash> seen;
  seen.reserve(mesh.faces.size());
  TriangleMesh result{.vertices = mesh.vertices, .faces = {}};
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    Corners corners;
    for (int k = 0; k < 3; ++k) {
      const Vec3& corner = mesh.corner(f, k);
      corners[k] = {corner.x(), corner.y(), corner.z()};
    }
    std::ranges::sort(corners);
    if (seen.insert(corners).second) result.faces.push_back(mesh.faces[f]);
  }
  return result;
}

/// Points on the surface, as many to an area everywhere: the area is divided into equal strips with
/// a point in each.
std::vector<Vec3> points_on(const TriangleMesh& mesh, int count, Random& random) {
  std::vector<double> until;  // area of all faces up to this one
  double area = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    until.push_back(area += area_vector2(mesh, f).norm() / 2);
  }
  std::vector<Vec3> points;
  if (!(area > 0)) return points;
  for (int k = 0; k < count; ++k) {
    const double at = area * (k + random.uniform()) / count;
    const auto face = static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(std::ranges::upper_bound(until, at) - until.begin(),
                                 static_cast<std::ptrdiff_t>(until.size()) - 1));
    const double r = std::sqrt(random.uniform());
    const double s = random.uniform();
    points.push_back((1 - r) * mesh.corner(face, 0) + r * (1 - s) * mesh.corner(face, 1) +
                     r * s * mesh.corner(face, 2));
  }
  return points;
}

constexpr std::size_t kAtATime = 8;

/// Calls next(distance) for the points in their order until it returns false. Points come face by
/// face: those in a row are close together, and what was near one is a good start for the others.
template <typename Next>
void for_each_distance(const std::vector<Vec3>& points, const TriangleTree& surface,
                       const Next& next) {
  std::int32_t near = -1;
  for (std::size_t first = 0; first < points.size(); first += kAtATime) {
    TriangleTree::Group<kAtATime> group;
    for (std::size_t k = 0; k < kAtATime; ++k) {
      group.queries[k] = points[std::min(first + k, points.size() - 1)];
      group.start[k] = near;
    }
    const auto found = surface.nearest(group);
    for (std::size_t k = 0; k < kAtATime && first + k < points.size(); ++k) {
      if (!next(std::sqrt(found[k].squared_distance))) return;
    }
    near = found[kAtATime - 1].triangle;
  }
}

std::vector<double> distances(const std::vector<Vec3>& points, const TriangleTree& surface) {
  std::vector<double> result;
  result.reserve(points.size());
  for_each_distance(points, surface, [&](double distance) {
    result.push_back(distance);
    return true;
  });
  return result;
}

double distance(const Vec3& point, const BoundingBox& box) {
  return (point - point.cwiseMax(box.low).cwiseMin(box.high)).norm();
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile_95(std::vector<double> values) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

/// A surface with points on it.
struct SampledFracture::Sampled {
  TriangleTree surface;
  std::vector<Vec3> points;
  BoundingBox box = {};
  double volume = 0;  ///< inside, where it is closed

  /// Mean distance of the points from the other surface; what is more than `matters` may be told as
  /// any number above it.
  double mean_distance(const Sampled& other, double matters) const {
    const auto count = static_cast<double>(points.size());
    double sum = 0;
    for_each_distance(points, other.surface, [&](double distance) {
      sum += distance;
      return sum <= matters * count;
    });
    return sum / count;
  }

  /// At most as much; takes no time.
  double least_mean_distance(const Sampled& other) const {
    // m; above the rounding of coordinates.
    constexpr double rounding = 1e-9;
    double sum = 0;
    for (const Vec3& p : points) sum += distance(p, other.box);
    return sum / static_cast<double>(points.size()) - rounding;
  }
};

SampledFracture::SampledFracture(const Fragments& fragments, const SurfaceSamples& samples,
                                 Random& random) {
  const TriangleMesh cracks = fracture_surface(fragments);
  std::vector<Vec3> on_cracks = points_on(cracks, samples.fracture_surface, random);
  if (!on_cracks.empty()) {
    surface_ = std::make_unique<Sampled>(
        Sampled{.surface = TriangleTree(without_twins(cracks)), .points = std::move(on_cracks)});
  }
  for (const Fragment& fragment : fragments) {
    std::vector<Vec3> points = points_on(fragment.mesh, samples.fragment, random);
    if (points.empty()) continue;
    fragments_.push_back({.surface = TriangleTree(fragment.mesh),
                          .points = std::move(points),
                          .box = bounding_box(fragment.mesh),
                          .volume = std::abs(volume(fragment.mesh))});
  }
}

SampledFracture::~SampledFracture() = default;
SampledFracture::SampledFracture(SampledFracture&&) noexcept = default;
SampledFracture& SampledFracture::operator=(SampledFracture&&) noexcept = default;

std::optional<FractureSurfaceAgreement> SampledFracture::surface_agreement(
    const SampledFracture& other) const {
  if (!surface_ || !other.surface_) return std::nullopt;
  const std::vector<double> forth = distances(surface_->points, other.surface_->surface);
  const std::vector<double> back = distances(other.surface_->points, surface_->surface);
  return FractureSurfaceAgreement{.chamfer = (mean(forth) + mean(back)) / 2,
                                  .hausdorff_95 = std::max(quantile_95(forth), quantile_95(back))};
}

std::optional<double> SampledFracture::fragment_chamfer(const SampledFracture& other) const {
  if (fragments_.empty() || other.fragments_.empty()) return std::nullopt;
  constexpr double far = std::numeric_limits<double>::infinity();
  std::vector<double> nearest(fragments_.size(), far);
  std::vector<double> nearest_of_other(other.fragments_.size(), far);
  struct Pair {
    std::size_t i, j;
    double least_forth, least_back;  ///< mean distances that it may have
    double least() const { return (least_forth + least_back) / 2; }
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < fragments_.size(); ++i) {
    for (std::size_t j = 0; j < other.fragments_.size(); ++j) {
      pairs.push_back({.i = i,
                       .j = j,
                       .least_forth = fragments_[i].least_mean_distance(other.fragments_[j]),
                       .least_back = other.fragments_[j].least_mean_distance(fragments_[i])});
    }
  }
  // Those that may be near come first, and spare most others the looking.
  std::ranges::sort(pairs, {}, &Pair::least);
  for (const Pair& pair : pairs) {
    const auto [i, j, least_forth, least_back] = pair;
    const double matters_below = std::max(nearest[i], nearest_of_other[j]);
    if (pair.least() > matters_below) continue;
    // A little more, so that rounding never hides what is no farther than the nearest.
    const double matters = 2 * matters_below * (1 + 1e-12);
    // The way of which less is known tells more: a small fragment is amid a large one's box.
    const bool is_forth_first = least_forth < least_back;
    const double least_second = std::max(least_forth, least_back);
    const Sampled& a = is_forth_first ? fragments_[i] : other.fragments_[j];
    const Sampled& b = is_forth_first ? other.fragments_[j] : fragments_[i];
    const double first = a.mean_distance(b, matters - least_second);
    if (first + least_second > matters) continue;
    const double second = b.mean_distance(a, matters - first);
    if (first + second > matters) continue;
    const double chamfer = (first + second) / 2;
    nearest[i] = std::min(nearest[i], chamfer);
    nearest_of_other[j] = std::min(nearest_of_other[j], chamfer);
  }
  const auto weighted = [](const std::vector<Sampled>& fragments,
                           const std::vector<double>& distance) {
    double sum = 0;
    double volumes = 0;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      sum += fragments[i].volume * distance[i];
      volumes += fragments[i].volume;
    }
    return volumes > 0 ? sum / volumes : 0.0;
  };
  return (weighted(fragments_, nearest) + weighted(other.fragments_, nearest_of_other)) / 2;
}

}  // namespace fracbench
