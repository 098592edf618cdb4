#pragma once

#include <memory>
#include <vector>

#include "metrics/metric.h"

namespace fracbench {

/// All metrics of a cell, in the order of the documentation.
const std::vector<std::unique_ptr<Metric>>& metrics();

}  // namespace fracbench
