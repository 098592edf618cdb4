#include "metrics/fracture_normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/sum.h"
#include "geometry/measures.h"
#include "metrics/measurement.h"

namespace fracbench {

MetricInfo FractureNormals::info() const {
  return {.name = "fracture_normals",
          .summary = "how fracture surfaces lie to the impulse, and their fabric tensor"};
}

Measurement FractureNormals::measure(const CellResult& cell) const {
  const bool has_direction = !cell.impacts.empty() && !cell.impacts.front().impulses.empty();
  const Vec3 d = has_direction ? cell.impacts.front().impulses.front().direction.normalized()
                               : Vec3::Zero().eval();
  Sum total;
  Sum along;
  Sum across;
  std::array<Sum, 9> fabric_sum;
  for (const Fragment& fragment : measurable(cell.fragments)) {
    for (std::size_t f = 0; f < fragment.faces.size(); ++f) {
      if (!fragment.faces[f].is_fracture()) continue;
      const Vec3 vector = area_vector2(fragment.mesh, f) / 2;
      const double size = vector.norm();
      if (size == 0) continue;
      total += size;
      along += std::abs(vector.dot(d));
      across += vector.cross(d).norm();
      for (int k = 0; k < 9; ++k) fabric_sum[k] += vector[k / 3] * vector[k % 3] / size;
    }
  }
  Measurement result;
  if (!(total.value() > 0)) return result;
  if (has_direction) {
    add_value(result, "normal_along", along.value() / total.value());
    add_value(result, "normal_across", across.value() / total.value());
  }
  Mat3 fabric;
  for (int k = 0; k < 9; ++k) fabric(k / 3, k % 3) = fabric_sum[k].value() / total.value();
  const Vec3 ascending = Eigen::SelfAdjointEigenSolver<Mat3>(fabric, false).eigenvalues();
  for (int k = 0; k < 3; ++k) {
    // A zero eigenvalue may come out as a rounding error below it.
    add_value(result, "fabric_" + std::to_string(k + 1), std::max(0.0, ascending[2 - k]));
  }
  add_value(result, "fracture_area", total.value() / 2, "m^2");
  return result;
}

}  // namespace fracbench
