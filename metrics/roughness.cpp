#include "metrics/roughness.h"

#include <Eigen/Eigenvalues>
#include <map>
#include <numbers>
#include <set>

#include "core/sum.h"
#include "geometry/measures.h"
#include "metrics/measurement.h"

namespace fracbench {
namespace {

// Normal of the best-fit plane of some faces.
Vec3 plane_normal(const TriangleMesh& mesh, const std::vector<std::size_t>& faces) {
  // Moments are taken about a point of the patch, so that nothing cancels far from the origin.
  const Vec3 base = mesh.corner(faces.front(), 0);
  double total = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (const std::size_t f : faces) {
    const double size = area_vector2(mesh, f).norm() / 2;
    const Vec3 a = mesh.corner(f, 0) - base;
    const Vec3 b = mesh.corner(f, 1) - base;
    const Vec3 c = mesh.corner(f, 2) - base;
    const Vec3 sum = a + b + c;
    total += size;
    first += size / 3 * sum;
    // Integral of x x^T over a triangle.
    second += size / 12 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  const Vec3 mean = first / total;
  second -= total * mean * mean.transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(second).eigenvectors().col(0);
}

// Between a vector and a line; accurate near 0, where an arc cosine is not.
double degrees_between(const Vec3& vector, const Vec3& line) {
  return std::atan2(vector.cross(line).norm(), std::abs(vector.dot(line))) * 180 / std::numbers::pi;
}

}  // namespace

MetricInfo Roughness::info() const {
  return {.name = "roughness",
          .summary = "mean angle between fracture faces and the best-fit plane of their interface"};
}

Measurement Roughness::measure(const CellResult& cell) const {
  Sum total;
  Sum weighted;
  std::set<std::int32_t> interfaces;
  MetricSeries series{.name = "interface_roughness", .values = {}, .unit = "degree"};
  for (const Fragment& fragment : measurable(cell.fragments)) {
    std::map<std::int32_t, std::vector<std::size_t>> patches;
    for (std::size_t f = 0; f < fragment.faces.size(); ++f) {
      const FragmentFace& tag = fragment.faces[f];
      if (!tag.is_fracture() || tag.interface < 0) continue;
      interfaces.insert(tag.interface);
      if (area_vector2(fragment.mesh, f).norm() > 0) patches[tag.interface].push_back(f);
    }
    for (const auto& [interface, faces] : patches) {
      const Vec3 normal = plane_normal(fragment.mesh, faces);
      Sum patch;
      Sum patch_weighted;
      for (const std::size_t f : faces) {
        const Vec3 vector = area_vector2(fragment.mesh, f) / 2;
        patch += vector.norm();
        patch_weighted += vector.norm() * degrees_between(vector, normal);
      }
      total += patch.value();
      weighted += patch_weighted.value();
      series.values.push_back(patch_weighted.value() / patch.value());
    }
  }
  Measurement result;
  if (!(total.value() > 0)) return result;
  add_value(result, "roughness", weighted.value() / total.value(), "degree");
  add_value(result, "interface_count", static_cast<double>(interfaces.size()));
  result.series.push_back(std::move(series));
  return result;
}

}  // namespace fracbench
