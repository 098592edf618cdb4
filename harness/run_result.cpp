#include "harness/run_result.h"

#include <nlohmann/json.hpp>

namespace fracbench {

nlohmann::ordered_json counts_as_json(const RunResult& result) {
  nlohmann::ordered_json json{{"cells", result.cells},
                              {"found", result.found},
                              {"complete", result.complete()},
                              {"stopped", result.stopped}};
  for (const CellStatus status : kCellStatuses) {
    json[std::string(to_string(status))] = result.count(status);
  }
  return json;
}

}  // namespace fracbench
