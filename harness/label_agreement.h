#pragma once

#include <filesystem>

#include "harness/summaries.h"

namespace fracbench {

/// Name of the value that add_label_agreement adds.
inline constexpr const char* kLabelAgreement = "label_agreement";

/// Adds to each cell that broke its target the adjusted Rand index of its fragments and those of
/// the method bem for the same impact in the same results (reference_agreement.h). Reads their
/// records again. Nothing where bem was not measured.
void add_label_agreement(const std::filesystem::path& folder, Results& results);

}  // namespace fracbench
