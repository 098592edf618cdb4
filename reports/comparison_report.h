#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "harness/compare.h"

namespace fracbench {

/// A comparison in four forms. All of them end with the verdict, or begin with it, and name each
/// gate with its change, limit, noise and p-value; none holds times of day, so that the same
/// records give the same bytes.

/// Plain text for a terminal: what failed first.
std::string comparison_text(const Comparison& comparison);

/// For the summary page of a CI service.
std::string comparison_markdown(const Comparison& comparison);

/// One object: `verdict`, `exit_code`, `suite`, `compared`, `gates`, `status_regressions`,
/// `problems`, `notes`. What does not exist is null.
nlohmann::ordered_json comparison_json(const Comparison& comparison);

/// JUnit XML: a test case for each gate and method, one for the statuses, one for completeness. A
/// regression is a failure, a gate that could not be judged an error, what is only reported is
/// skipped.
std::string comparison_junit(const Comparison& comparison);

}  // namespace fracbench
