#pragma once

#include "harness/conformance/bench.h"
#include "harness/conformance/check_result.h"

/// Whether a method takes no more memory than allowed, and gives it back.
namespace fracbench::conformance {

CheckResult check_memory(const Bench& bench);

}  // namespace fracbench::conformance
