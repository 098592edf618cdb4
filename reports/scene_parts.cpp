#include "reports/scene_parts.h"

#include <nlohmann/json.hpp>

namespace fracbench {

Fragments shown_fragments(const Record& record, const TriangleMesh& target) {
  const Fragments& fragments = record.outcome.scene.fragments;
  if (!fragments.empty()) return fragments;
  return {{.mesh = target,
           .faces = std::vector<FragmentFace>(target.faces.size(), {.original_face = 0})}};
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
