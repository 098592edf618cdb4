#include "harness/acceptance.h"

#include <nlohmann/json.hpp>

namespace fracbench {

nlohmann::ordered_json to_json(const Acceptance& note) {
  return {{"when", note.when},
          {"who", note.who},
          {"why", note.why},
          {"suite", note.suite},
          {"cells", note.cells}};
}

Acceptance acceptance_from_json(const nlohmann::ordered_json& json) {
  return {.when = json.at("when"),
          .who = json.at("who"),
          .why = json.at("why"),
          .suite = json.at("suite"),
          .cells = json.at("cells")};
}

}  // namespace fracbench
