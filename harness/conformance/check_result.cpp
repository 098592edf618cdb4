#include "harness/conformance/check_result.h"

#include <utility>

namespace fracbench {

std::string_view to_string(Conformity conformity) {
  switch (conformity) {
    case Conformity::passed:
      return "passed";
    case Conformity::failed:
      return "failed";
    case Conformity::skipped:
      break;
  }
  return "skipped";
}

namespace conformance {

CheckResult passed(std::string detail) { return {Conformity::passed, std::move(detail)}; }
CheckResult failed(std::string detail) { return {Conformity::failed, std::move(detail)}; }
CheckResult skipped(std::string detail) { return {Conformity::skipped, std::move(detail)}; }

}  // namespace conformance
}  // namespace fracbench
