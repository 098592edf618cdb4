#pragma once

#include "harness/conformance/bench.h"
#include "harness/conformance/check_result.h"

/// Whether the fragments of a blow are sound.
namespace fracbench::conformance {

CheckResult check_tags(const Bench& bench);
CheckResult check_closed(const Bench& bench);
CheckResult check_disjoint(const Bench& bench);
CheckResult check_volume(const Bench& bench);
CheckResult check_surface(const Bench& bench);
CheckResult check_weak_blow(const Bench& bench);

}  // namespace fracbench::conformance
