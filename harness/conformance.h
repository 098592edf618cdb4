#pragma once

#include <string>
#include <vector>

#include "harness/conformance/bench.h"
#include "harness/conformance/check_result.h"

namespace fracbench {

/// One promise that a method makes by being one.
struct Check {
  std::string name;
  std::string summary;  ///< what must hold, one line
};

/// All checks, in the order in which they are best made.
const std::vector<Check>& conformance_checks();

/// Makes one check, in this process: what crashes or hangs, takes it along. Throws InputError for
/// a name that is not one of conformance_checks, and where the method does not like its options.
CheckResult make_check(const std::string& name, const CheckSubject& subject);

}  // namespace fracbench
