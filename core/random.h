#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string_view>

#include "core/vec3.h"

namespace fracbench {

/// A seed that depends on every part and on their order, and on nothing else (SHA-256).
std::uint64_t derive_seed(std::uint64_t seed, std::initializer_list<std::string_view> parts);

/// Random numbers whose values are fixed by the seed on every platform: the engine is the
/// standard's mt19937_64, the distributions are our own, because those of the standard library
/// differ between implementations.
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(seed), engine_(seed) {}

  std::uint64_t seed() const { return seed_; }
  std::uint64_t bits() { return engine_(); }

  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high);
  /// Uniform in {0, ..., count - 1}, without bias; count > 0.
  std::uint64_t below(std::uint64_t count);
  /// Standard normal (polar method of Marsaglia).
  double normal();
  /// Uniform on the unit sphere.
  Vec3 unit_vector();

  /// A generator that is independent of this one and of its siblings of other names; it takes
  /// nothing from this one's sequence.
  Random fork(std::string_view name) const;

 private:
  std::uint64_t seed_;
  std::mt19937_64 engine_;
};

}  // namespace fracbench
