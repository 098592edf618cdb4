#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/fragments.h"
#include "core/random.h"
#include "metrics/fracture_surface_agreement.h"
#include "metrics/partition_agreement.h"

namespace fracbench {

/// How well two fractures of one body agree.
struct FractureAgreement {
  PartitionAgreement partition = {};  ///< of the samples inside; the first fracture is A
  std::optional<FractureSurfaceAgreement> surfaces = {};
  std::optional<double> fragment_chamfer = {};  ///< m
  bool operator==(const FractureAgreement&) const = default;
};

/// At which places fractures are compared.
struct FractureSamples {
  int resolution = 64;  ///< of the grid
  SurfaceSamples surfaces = {};
};

/// A fracture, ready to be compared with many others. Safe to use from many threads.
class ComparableFracture {
 public:
  /// The fragments must be closed.
  ComparableFracture(const Fragments& fragments, const FractureSamples& samples, Random& random);

  /// With one that was sampled at the same resolution.
  FractureAgreement agreement(const ComparableFracture& other) const;

 private:
  std::vector<std::int32_t> labels_;
  SampledFracture surfaces_;
};

}  // namespace fracbench
