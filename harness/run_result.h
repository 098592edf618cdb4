#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>

#include "harness/cell_status.h"

namespace fracbench {

/// What a run has to show.
struct RunResult {
  std::size_t cells = 0;                          ///< that were asked for
  std::size_t found = 0;                          ///< of them: their records were there already
  bool stopped = false;                           ///< somebody asked to stop before the end
  std::map<CellStatus, std::size_t> counts = {};  ///< over all records that are there now

  std::size_t count(CellStatus status) const {
    const auto at = counts.find(status);
    return at == counts.end() ? 0 : at->second;
  }
  std::size_t recorded() const {
    std::size_t sum = 0;
    for (const auto& [status, number] : counts) sum += number;
    return sum;
  }
  /// Cells that say something about fracture: broken or whole.
  std::size_t measured() const { return count(CellStatus::ok) + count(CellStatus::unbroken); }
  bool complete() const { return recorded() == cells; }
};

/// "cells", "found", "complete", "stopped" and a count for each status by its name, 0 included.
nlohmann::ordered_json counts_as_json(const RunResult& result);

}  // namespace fracbench
