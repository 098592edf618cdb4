#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "metrics/metric.h"

namespace fracbench {

/// What `fracture` and `score` answer, under the names that scripts rely on: status,
/// fragment_count, volume_ratio, closed, disjoint, surface_retention, volumes, stage_seconds,
/// total_seconds, peak_memory_mb, metrics. Runs every metric on the cell; the status is `invalid`
/// where the metric `validity` says so, else `ok`, or `unbroken` for a single fragment.
nlohmann::ordered_json result_json(const CellResult& cell);

/// The same in a few lines for people.
std::string describe_result(const nlohmann::ordered_json& result);

}  // namespace fracbench
