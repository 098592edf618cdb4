#pragma once

#include <span>
#include <vector>

#include "core/random.h"
#include "neural/network_options.h"

namespace fracbench::neural {

/// The frozen encoder E of impulses: one sine layer, z = sin(w_0 (W x + b)), with W and b uniform
/// in
/// +-sqrt(6 / 7) (SIREN's first layers as the authors use them). It is never trained.
struct Siren {
  double omega = 1;
  std::vector<float> weight;  ///< rows of 7 values, one for each value of the code
  std::vector<float> bias;

  bool operator==(const Siren&) const = default;
};

Siren make_siren(const NetworkOptions& options, Random& random);

/// The codes of all impulses, one after the other: 7 values become bias.size() each.
std::vector<float> encode(const Siren& siren, std::span<const float> impulses);

}  // namespace fracbench::neural
