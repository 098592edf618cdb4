#include "neural/siren.h"

#include <cmath>

#include "core/impulse_vector.h"

namespace fracbench::neural {

Siren make_siren(const NetworkOptions& options, Random& random) {
  const double bound = std::sqrt(6.0 / kImpulseValues);
  Siren siren{.omega = options.omega, .weight = {}, .bias = {}};
  for (int k = 0; k < options.impulse_code * kImpulseValues; ++k) {
    siren.weight.push_back(static_cast<float>(random.uniform(-bound, bound)));
  }
  for (int k = 0; k < options.impulse_code; ++k) {
    siren.bias.push_back(static_cast<float>(random.uniform(-bound, bound)));
  }
  return siren;
}

std::vector<float> encode(const Siren& siren, std::span<const float> impulses) {
  std::vector<float> code;
  for (std::size_t at = 0; at + kImpulseValues <= impulses.size(); at += kImpulseValues) {
    for (std::size_t row = 0; row < siren.bias.size(); ++row) {
      double sum = siren.bias[row];
      for (int c = 0; c < kImpulseValues; ++c) {
        sum += static_cast<double>(siren.weight[row * kImpulseValues + c]) * impulses[at + c];
      }
      code.push_back(static_cast<float>(std::sin(siren.omega * sum)));
    }
  }
  return code;
}

}  // namespace fracbench::neural
