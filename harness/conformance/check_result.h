#pragma once

#include <string>
#include <string_view>

namespace fracbench {

enum class Conformity { passed, failed, skipped };
std::string_view to_string(Conformity conformity);

/// What came of one check.
struct CheckResult {
  Conformity conformity = Conformity::passed;
  std::string detail;  ///< what was found, or why it was skipped
};

namespace conformance {

CheckResult passed(std::string detail = {});
CheckResult failed(std::string detail);
CheckResult skipped(std::string detail);

}  // namespace conformance
}  // namespace fracbench
