#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/cell_summary.h"

namespace fracbench {

/// How well two fractures of one shape agree on what belongs together.
struct LabelAgreement {
  std::string shape;
  std::string label;             ///< of the method that is compared with the reference
  std::string family, scenario;  ///< of the impact on it
  int repeat = 0;
  bool other_impact = false;  ///< the reference itself, under another impact: the floor
  double index = 0;           ///< adjusted Rand index
};

struct AgreementOptions {
  std::string reference = "bem";  ///< label of the method that the others are compared with
  int resolution = 64;            ///< of the grid whose samples are compared
  int threads = 2;
};

/// Compares the fragments of every cell that broke its target with those of the reference method
/// under the same impact, and the reference's own under each impact with those under the next one
/// of its shape. Reads the records of `cells` from a results folder. Empty where the reference
/// broke nothing. Throws DataError for a record that cannot be read.
std::vector<LabelAgreement> agreement_with_reference(const std::filesystem::path& folder,
                                                     const std::vector<CellSummary>& cells,
                                                     const AgreementOptions& options = {});

}  // namespace fracbench
