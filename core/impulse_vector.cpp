#include "core/impulse_vector.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace fracbench {

ImpulseScaling impulse_scaling(const TriangleMesh& target, double max_impulse) {
  if (target.vertices.empty()) throw InputError("impulses of a mesh without vertices");
  if (!(max_impulse > 0)) {
    throw InputError(fmt::format(
        "the largest impulse of the learning data is {} N s, must be above 0; make it anew",
        max_impulse));
  }
  Vec3 low = target.vertices[0], high = low;
  for (const Vec3& vertex : target.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return {.centre = (low + high) / 2,
          .half_side = (high - low).maxCoeff() / 2,
          .max_impulse = max_impulse};
}

std::array<double, kScalingValues> scaling_values(const ImpulseScaling& scaling) {
  const Vec3& c = scaling.centre;
  return {c.x(), c.y(), c.z(), scaling.half_side, scaling.max_impulse};
}

ImpulseScaling scaling_of(std::span<const double, kScalingValues> values) {
  return {.centre = {values[0], values[1], values[2]},
          .half_side = values[3],
          .max_impulse = values[4]};
}

std::vector<float> impulse_vector(const Impact& impact, const ImpulseScaling& scaling,
                                  int features) {
  std::vector<float> values;
  for (std::size_t k = 0; k < static_cast<std::size_t>(features); ++k) {
    Vec3 point = Vec3::Zero(), direction = Vec3::Zero();
    double strength = -1;
    if (k < impact.impulses.size()) {
      const Impulse& impulse = impact.impulses[k];
      point = (impulse.point - scaling.centre) / scaling.half_side;
      direction = impulse.direction;
      strength = 2 * impulse.magnitude / scaling.max_impulse - 1;
    }
    for (const Vec3& part : {point, direction}) {
      for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(part[c]));
    }
    values.push_back(static_cast<float>(strength));
  }
  return values;
}

}  // namespace fracbench
