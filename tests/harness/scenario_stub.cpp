#include <nlohmann/json.hpp>

#include "scenarios/scenario.h"

namespace fracbench {

// Stands in until the scenarios have an implementation; goes with it.
[[gnu::weak]] nlohmann::ordered_json to_json(const Scenario& scenario) {
  nlohmann::ordered_json json{{"name", scenario.name}, {"family", scenario.family}};
  for (const Ball& ball : scenario.balls) {
    json["balls"].push_back({ball.position.x(), ball.position.y(), ball.position.z(),
                             ball.velocity.x(), ball.velocity.y(), ball.velocity.z()});
  }
  return json;
}

}  // namespace fracbench
