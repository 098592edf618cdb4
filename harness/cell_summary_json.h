#pragma once

#include <nlohmann/json_fwd.hpp>

#include "harness/cell_summary.h"

namespace fracbench {

/// All that a summary holds but for the result's digest; numbers keep all their bits.
nlohmann::ordered_json to_json(const CellSummary& cell);

/// The other way round. Throws nlohmann::json::exception or std::bad_optional_access where the
/// value is no summary.
CellSummary cell_summary_from_json(const nlohmann::ordered_json& json);

}  // namespace fracbench
