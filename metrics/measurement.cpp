#include "metrics/measurement.h"

#include <algorithm>
#include <cmath>

namespace fracbench {

void add_value(Measurement& measurement, std::string name, double value, std::string unit) {
  if (!std::isfinite(value)) return;
  measurement.values.push_back({.name = std::move(name), .value = value, .unit = std::move(unit)});
}

bool is_well_formed(const Fragment& fragment) {
  const auto count = static_cast<std::int32_t>(fragment.mesh.vertices.size());
  return fragment.faces.size() == fragment.mesh.faces.size() &&
         std::ranges::all_of(fragment.mesh.vertices, [](const Vec3& v) { return v.allFinite(); }) &&
         std::ranges::all_of(fragment.mesh.faces, [&](const Face& face) {
           return std::ranges::all_of(face, [&](auto i) { return i >= 0 && i < count; });
         });
}

std::vector<std::reference_wrapper<const Fragment>> measurable(const Fragments& fragments) {
  std::vector<std::reference_wrapper<const Fragment>> result;
  for (const Fragment& fragment : fragments) {
    if (is_well_formed(fragment)) result.emplace_back(fragment);
  }
  return result;
}

}  // namespace fracbench
