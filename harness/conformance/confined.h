#pragma once

#include "harness/conformance/bench.h"
#include "harness/conformance/check_result.h"

/// Whether a method leaves, changes or removes files where it has no business.
namespace fracbench::conformance {

CheckResult check_confined(const Bench& bench);

}  // namespace fracbench::conformance
