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

/// A fragment, ready to be compared with many.
struct Sampled {
  SurfaceDistance surface;
  std::vector<Vec3> points;
  double volume;
};

std::vector<Sampled> sampled(const Fragments& fragments, int samples, Random& random) {
  std::vector<Sampled> result;
  for (const Fragment& fragment : fragments) {
    if (fragment.mesh.empty()) continue;
    std::vector<Vec3> points = points_on(fragment.mesh, samples, random);
    if (points.empty()) continue;
    result.push_back(
        {SurfaceDistance(fragment.mesh), std::move(points), std::abs(volume(fragment.mesh))});
  }
  return result;
}

}  // namespace

std::optional<FractureSurfaceAgreement> fracture_surface_agreement(const Fragments& a,
                                                                   const Fragments& b, int samples,
                                                                   Random& random) {
  const TriangleMesh of_a = fracture_surface(a);
  const TriangleMesh of_b = fracture_surface(b);
  const std::vector<Vec3> on_a = points_on(of_a, samples, random);
  const std::vector<Vec3> on_b = points_on(of_b, samples, random);
  if (on_a.empty() || on_b.empty()) return std::nullopt;
  const std::vector<double> a_to_b = distances(on_a, SurfaceDistance(of_b));
  const std::vector<double> b_to_a = distances(on_b, SurfaceDistance(of_a));
  return FractureSurfaceAgreement{
      .chamfer = (mean(a_to_b) + mean(b_to_a)) / 2,
      .hausdorff_95 = std::max(quantile_95(a_to_b), quantile_95(b_to_a))};
}

std::optional<double> fragment_chamfer(const Fragments& a, const Fragments& b, int samples,
                                       Random& random) {
  const std::vector<Sampled> of_a = sampled(a, samples, random);
  const std::vector<Sampled> of_b = sampled(b, samples, random);
  if (of_a.empty() || of_b.empty()) return std::nullopt;
  constexpr double far = std::numeric_limits<double>::infinity();
  std::vector<double> nearest_of_a(of_a.size(), far);
  std::vector<double> nearest_of_b(of_b.size(), far);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    for (std::size_t j = 0; j < of_b.size(); ++j) {
      const double chamfer = (mean(distances(of_a[i].points, of_b[j].surface)) +
                              mean(distances(of_b[j].points, of_a[i].surface))) /
                             2;
      nearest_of_a[i] = std::min(nearest_of_a[i], chamfer);
      nearest_of_b[j] = std::min(nearest_of_b[j], chamfer);
    }
  }
  const auto weighted = [](const std::vector<Sampled>& fragments,
                           const std::vector<double>& far_by) {
    double sum = 0;
    double volumes = 0;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      sum += fragments[i].volume * far_by[i];
      volumes += fragments[i].volume;
    }
    return volumes > 0 ? sum / volumes : 0.0;
  };
  return (weighted(of_a, nearest_of_a) + weighted(of_b, nearest_of_b)) / 2;
}

}  // namespace fracbench
