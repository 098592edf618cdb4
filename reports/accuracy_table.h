#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "harness/validation_run.h"
#include "reports/table.h"

namespace fracbench {

/// Case, reference, computed, error, tolerance, pass, and where the reference comes from (or why
/// there is no value).
Table accuracy_table(const ValidationRun& run, std::string_view method);

/// An array of objects with `case`, `reference`, `computed`, `error`, `tolerance`, `pass`, `group`
/// (the name of the validation case), `unit`, `source`, and `reason` where a case gave no value;
/// numbers that do not exist are null.
nlohmann::ordered_json accuracy_json(const ValidationRun& run);

/// Writes accuracy.md and accuracy.csv into `folder`, each whole or not at all. Throws InputError
/// where they cannot be written.
void write_accuracy(const ValidationRun& run, std::string_view method,
                    const std::filesystem::path& folder);

}  // namespace fracbench
