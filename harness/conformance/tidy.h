#pragma once

#include "harness/conformance/bench.h"
#include "harness/conformance/check_result.h"

/// Whether a method leaves files behind where it works.
namespace fracbench::conformance {

CheckResult check_tidy(const Bench& bench);

}  // namespace fracbench::conformance
