#include "scenarios/scenario.h"

#include <nlohmann/json.hpp>

#include "core/material_json.h"
#include "scenarios/break_test.h"

namespace fracbench {

namespace {

nlohmann::ordered_json to_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json to_json(const Material& material) {
  nlohmann::ordered_json json = breaking_json(material);
  json["friction"] = material.friction;
  json["restitution"] = material.restitution;
  return json;
}

Vec3 vec3_from_json(const nlohmann::ordered_json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Material material_from_json(const nlohmann::ordered_json& json) {
  return {.young_modulus = json.at("young_modulus").get<double>(),
          .poisson_ratio = json.at("poisson_ratio").get<double>(),
          .density = json.at("density").get<double>(),
          .strength = json.at("strength").get<double>(),
          .toughness = json.at("toughness").get<double>(),
          .compressive_factor = json.at("compressive_factor").get<double>(),
          .friction = json.at("friction").get<double>(),
          .restitution = json.at("restitution").get<double>()};
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
  for (const GivenImpulse& impulse : scenario.impulses) {
    json["impulses"].push_back({{"point", to_json(impulse.point)},
                                {"direction", to_json(impulse.direction)},
                                {"magnitude", impulse.magnitude}});
  }
  json["material"] = to_json(scenario.material);
  json["break_test"] = name_of(scenario.break_test);
  json["time_step"] = scenario.time_step;
  json["frames"] = scenario.frames;
  json["refracture"] = scenario.refracture;
  return json;
}

Scenario scenario_from_json(const nlohmann::ordered_json& json) {
  Scenario scenario{
      .name = json.at("name").get<std::string>(),
      .family = json.at("family").get<std::string>(),
      .balls = {},
      .material = material_from_json(json.at("material")),
      .break_test = break_test_from(json.at("break_test").get<std::string>(), "scenario"),
      .time_step = json.at("time_step").get<double>(),
      .frames = json.at("frames").get<int>(),
      .refracture = json.at("refracture").get<bool>()};
  for (const auto& item : json.at("balls")) {
    scenario.balls.push_back({.position = vec3_from_json(item.at("position")),
                              .velocity = vec3_from_json(item.at("velocity")),
                              .radius = item.at("radius").get<double>(),
                              .material = material_from_json(item.at("material"))});
  }
  if (json.contains("impulses")) {
    for (const auto& item : json.at("impulses")) {
      scenario.impulses.push_back({.point = vec3_from_json(item.at("point")),
                                   .direction = vec3_from_json(item.at("direction")),
                                   .magnitude = item.at("magnitude").get<double>()});
    }
  }
  return scenario;
}

}  // namespace fracbench
