#include "metrics/fracture_surface_agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "geometry/measures.h"
#include "geometry/surface_distance.h"

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

std::vector<double> distances(const std::vector<Vec3>& points, const SurfaceDistance& surface) {
  std::vector<double> result;
  for (const Vec3& p : points) result.push_back(surface.nearest(p).distance);
  return result;
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
  SurfaceDistance surface;
  std::vector<Vec3> points;
  double volume = 0;  ///< inside, where it is closed
};

SampledFracture::SampledFracture(const Fragments& fragments, const SurfaceSamples& samples,
                                 Random& random) {
  const TriangleMesh cracks = fracture_surface(fragments);
  std::vector<Vec3> on_cracks = points_on(cracks, samples.fracture_surface, random);
  if (!on_cracks.empty()) {
    surface_ = std::make_unique<Sampled>(
        Sampled{.surface = SurfaceDistance(cracks), .points = std::move(on_cracks)});
  }
  for (const Fragment& fragment : fragments) {
    std::vector<Vec3> points = points_on(fragment.mesh, samples.fragment, random);
    if (points.empty()) continue;
    fragments_.push_back({.surface = SurfaceDistance(fragment.mesh),
                          .points = std::move(points),
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
  for (std::size_t i = 0; i < fragments_.size(); ++i) {
    for (std::size_t j = 0; j < other.fragments_.size(); ++j) {
      const double chamfer = (mean(distances(fragments_[i].points, other.fragments_[j].surface)) +
                              mean(distances(other.fragments_[j].points, fragments_[i].surface))) /
                             2;
      nearest[i] = std::min(nearest[i], chamfer);
      nearest_of_other[j] = std::min(nearest_of_other[j], chamfer);
    }
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
