#pragma once

#include "harness/conformance/bench.h"
#include "harness/conformance/check_result.h"

/// Whether work ends soon when it is asked to.
namespace fracbench::conformance {

CheckResult check_cancel(const Bench& bench);

}  // namespace fracbench::conformance
