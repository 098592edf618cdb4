#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/cell_summary.h"
#include "metrics/fracture_surface_agreement.h"
#include "metrics/partition_agreement.h"

namespace fracbench {

/// How well two fractures of one shape agree.
struct ReferenceAgreement {
  std::string shape;
  std::string label;             ///< of the method that is compared with the reference
  std::string family, scenario;  ///< of the impact on it
  int repeat = 0;
  bool other_impact = false;          ///< the reference itself, under another impact: the floor
  PartitionAgreement partition = {};  ///< of the samples inside; the reference is A
  std::optional<FractureSurfaceAgreement> surfaces = {};
  std::optional<double> fragment_chamfer = {};  ///< m
};

struct AgreementOptions {
  std::string reference = "bem";  ///< label of the method that the others are compared with
  int resolution = 64;            ///< of the grid whose samples are compared
  SurfaceSamples samples = {};
  int threads = 2;
};

/// Compares the fragments of every cell that broke its target with those of the reference method
/// under the same impact, and the reference's own under each impact with those under the next one
/// of its shape. Reads the records of `cells` from a results folder. Empty where the reference
/// broke nothing. The same for any number of threads. Throws DataError for a record that cannot be
/// read.
std::vector<ReferenceAgreement> agreement_with_reference(const std::filesystem::path& folder,
                                                         const std::vector<CellSummary>& cells,
                                                         const AgreementOptions& options = {});

}  // namespace fracbench
