#pragma once

#include "harness/conformance/bench.h"
#include "harness/conformance/check_result.h"

/// Whether an answer depends on what it should depend on, and on nothing else.
namespace fracbench::conformance {

CheckResult check_same_seed(const Bench& bench);
CheckResult check_other_seed(const Bench& bench);
CheckResult check_const_use(const Bench& bench);
CheckResult check_other_impact(const Bench& bench);
CheckResult check_save_load(const Bench& bench);

}  // namespace fracbench::conformance
