#pragma once

#include <string>
#include <vector>

#include "core/options.h"
#include "core/target.h"
#include "methods/method.h"

namespace fracbench {

enum class Conformity { passed, failed, skipped };
std::string_view to_string(Conformity conformity);

/// What came of one check.
struct CheckResult {
  Conformity conformity = Conformity::passed;
  std::string detail;  ///< what was found, or why it was skipped
};

/// One promise that a method makes by being one.
struct Check {
  std::string name;
  std::string summary;  ///< what must hold, one line
};

/// All checks, cheapest promises first.
const std::vector<Check>& conformance_checks();

/// What the checks are made with.
struct CheckSubject {
  const Method& method;
  Options options;
  const Target& target;
  double impulse = 2e5;     ///< of the blows, N s
  double memory_mb = 4000;  ///< MiB that preparing and breaking the body may take
  int threads = 1;
};

/// Makes one check, in this process: what crashes or hangs, takes it along. Throws InputError for
/// a name that is not one of conformance_checks, and where the method does not like its options.
CheckResult make_check(const std::string& name, const CheckSubject& subject);

}  // namespace fracbench
