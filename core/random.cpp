#include "core/random.h"

#include <cmath>

#include "core/digest.h"

namespace fracbench {

std::uint64_t derive_seed(std::uint64_t seed, std::initializer_list<std::string_view> parts) {
  Digest digest;
  digest.add(seed);
  for (const std::string_view part : parts) digest.add(part);
  return digest.word();
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

std::uint64_t Random::below(std::uint64_t count) {
  // Values above the largest multiple of count would favour the small remainders.
  const std::uint64_t excess = (UINT64_MAX % count + 1) % count;
  std::uint64_t value = bits();
  while (value > UINT64_MAX - excess) value = bits();
  return value % count;
}

double Random::normal() {
  while (true) {
    const double u = uniform(-1, 1);
    const double v = uniform(-1, 1);
    const double s = u * u + v * v;
    if (s > 0 && s < 1) return u * std::sqrt(-2 * std::log(s) / s);
  }
}

Vec3 Random::unit_vector() {
  // Marsaglia's rejection in the disc, which has no trigonometric functions in it.
  while (true) {
    const double u = uniform(-1, 1);
    const double v = uniform(-1, 1);
    const double s = u * u + v * v;
    if (s < 1) {
      const double w = 2 * std::sqrt(1 - s);
      return {u * w, v * w, 1 - 2 * s};
    }
  }
}

Random Random::fork(std::string_view name) const { return Random(derive_seed(seed_, {name})); }

}  // namespace fracbench
