#include "scenarios/scenario.h"

#include <nlohmann/json.hpp>

#include "scenarios/break_test.h"

namespace fracbench {

namespace {

nlohmann::ordered_json to_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json to_json(const Material& material) {
  nlohmann::ordered_json json;
  json["young_modulus"] = material.young_modulus;
  json["poisson_ratio"] = material.poisson_ratio;
  json["density"] = material.density;
  json["strength"] = material.strength;
  json["toughness"] = material.toughness;
  json["compressive_factor"] = material.compressive_factor;
  json["friction"] = material.friction;
  json["restitution"] = material.restitution;
  return json;
}

}  // namespace

nlohmann::ordered_json to_json(const Scenario& scenario) {
  nlohmann::ordered_json json;
  json["name"] = scenario.name;
  json["family"] = scenario.family;
  json["balls"] = nlohmann::ordered_json::array();
  for (const Ball& ball : scenario.balls) {
    nlohmann::ordered_json item;
    item["position"] = to_json(ball.position);
    item["velocity"] = to_json(ball.velocity);
    item["radius"] = ball.radius;
    item["material"] = to_json(ball.material);
    json["balls"].push_back(item);
  }
  json["material"] = to_json(scenario.material);
  json["break_test"] = name_of(scenario.break_test);
  json["time_step"] = scenario.time_step;
  json["frames"] = scenario.frames;
  json["refracture"] = scenario.refracture;
  return json;
}

}  // namespace fracbench
