#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/parallel.h"
#include "harness/cell_summary.h"
#include "metrics/fracture_agreement.h"

namespace fracbench {

/// How well a fracture agrees with that of the reference method.
struct ReferenceAgreement {
  std::string shape;
  std::string label;             ///< of the method that is compared with the reference
  std::string family, scenario;  ///< of the impact on it
  int repeat = 0;
  bool other_impact = false;         ///< the reference itself, under another impact: the floor
  FractureAgreement agreement = {};  ///< the reference is A
};

struct AgreementOptions {
  std::string reference = "bem";  ///< label of the method that the others are compared with
  FractureSamples samples = {};
  int threads = hardware_threads();
};

/// Compares the fragments of every cell that broke its target with those of the reference method
/// under the same impact, and the reference's own under each impact with those under the next one
/// of its shape. `cells` are summaries from a results folder: their records are read, where the
/// agreement is not kept there from before (AgreementCache). Empty where the reference broke
/// nothing. The same for any number of threads. Throws DataError for a record that cannot be read.
std::vector<ReferenceAgreement> agreement_with_reference(const std::filesystem::path& folder,
                                                         const std::vector<CellSummary>& cells,
                                                         const AgreementOptions& options = {});

}  // namespace fracbench
