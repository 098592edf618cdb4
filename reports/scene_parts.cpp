#include "reports/scene_parts.h"

#include <nlohmann/json.hpp>

#include "geometry/measures.h"

namespace fracbench {

Fragments shown_fragments(const Record& record, const TriangleMesh& target) {
  const Fragments& fragments = record.outcome.scene.fragments;
  if (!fragments.empty()) return fragments;
  return {{.mesh = target,
           .faces = std::vector<FragmentFace>(target.faces.size(), {.original_face = 0})}};
}

double fracture_area(const Fragment& fragment) {
  double area = 0;
  for (std::size_t f = 0; f < fragment.faces.size(); ++f) {
    if (fragment.faces[f].is_fracture()) area += area_vector2(fragment.mesh, f).norm() / 2;
  }
  return area;
}

std::vector<double> ball_radii(const Record& record) {
  std::vector<double> radii;
  const auto values = nlohmann::json::parse(record.identity.scenario_values, nullptr, false);
  if (!values.is_object()) return radii;
  const auto balls = values.value("balls", nlohmann::json::array());
  for (const auto& ball : balls) radii.push_back(ball.value("radius", 0.1));
  return radii;
}

}  // namespace fracbench
