#include "methods/bem/strength_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/random.h"

namespace fracbench::bem {
namespace {

// The sum's fourth moment is that of a normal distribution but for a share of 1 / (2 * modes).
constexpr int kModes = 512;

void require_positive(double value, std::string_view name, std::string_view unit) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw InputError(
        fmt::format("strength field: {} of {} {}: it must be above 0", name, value, unit));
  }
}

/// Uniform in [0, 1): a fixed function of a lattice cell, a seed and a channel (finaliser of
/// SplitMix64, Steele et al. 2014).
double lattice_noise(std::array<std::int64_t, 3> cell, std::uint64_t seed, std::uint64_t channel) {
  std::uint64_t z = seed;
  for (const std::uint64_t part :
       {static_cast<std::uint64_t>(cell[0]), static_cast<std::uint64_t>(cell[1]),
        static_cast<std::uint64_t>(cell[2]), channel}) {
    z += part + 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    z ^= z >> 31;
  }
  return static_cast<double>(z >> 11) * 0x1.0p-53;
}

}  // namespace

StrengthKind strength_kind(std::string_view name) {
  if (name == "homogeneous") return StrengthKind::homogeneous;
  if (name == "random") return StrengthKind::random;
  if (name == "layered") return StrengthKind::layered;
  if (name == "grain") return StrengthKind::grain;
  throw InputError(fmt::format(
      "strength field '{}' is not known: use homogeneous, random, layered or grain", name));
}

StrengthField::StrengthField(const StrengthOptions& options) : options_(options) {
  require_positive(options.mean, "mean strength", "Pa");
  switch (options.kind) {
    case StrengthKind::homogeneous:
      break;
    case StrengthKind::random: {
      require_positive(options.weibull_modulus, "Weibull modulus", "");
      require_positive(options.correlation_length, "correlation length", "m");
      weibull_scale_ = options.mean / std::tgamma(1 + 1 / options.weibull_modulus);
      Random random(derive_seed(options.seed, {"strength"}));
      modes_.resize(kModes);
      for (Mode& mode : modes_) {
        for (int a = 0; a < 3; ++a) mode.wave[a] = random.normal() / options.correlation_length;
        mode.phase = random.uniform(0, 2 * std::numbers::pi);
      }
      break;
    }
    case StrengthKind::layered:
      require_positive(options.direction.norm(), "length of the layers' normal", "");
      require_positive(options.thickness, "layer thickness", "m");
      require_positive(options.ratio, "ratio of strengths", "");
      layer_axis_ = options.direction.normalized();
      break;
    case StrengthKind::grain:
      require_positive(options.grain_size, "grain size", "m");
      require_positive(options.boundary_width, "width of the boundaries", "m");
      require_positive(options.ratio, "ratio of strengths", "");
      break;
  }
}

double StrengthField::gaussian(const Vec3& point) const {
  double sum = 0;
  for (const Mode& mode : modes_) sum += std::cos(mode.wave.dot(point) + mode.phase);
  return std::sqrt(2.0 / kModes) * sum;
}

double StrengthField::boundary_distance(const Vec3& point) const {
  const double size = options_.grain_size;
  const Vec3 scaled = point / size;
  std::array<std::int64_t, 3> home{};
  for (int a = 0; a < 3; ++a) home[a] = static_cast<std::int64_t>(std::floor(scaled[a]));
  // A cube two rings away is at least 2 sizes off, its point no nearer; the nearest point is at
  // most sqrt(3) sizes off, and the bisector with a point three rings away is far from weak.
  constexpr int kRings = 2;
  std::array<Vec3, (2 * kRings + 1) * (2 * kRings + 1) * (2 * kRings + 1)> sites;
  std::size_t count = 0, nearest = 0;
  for (int k = -kRings; k <= kRings; ++k) {
    for (int j = -kRings; j <= kRings; ++j) {
      for (int i = -kRings; i <= kRings; ++i) {
        const std::array<std::int64_t, 3> cell{home[0] + i, home[1] + j, home[2] + k};
        Vec3& site = sites[count];
        for (int a = 0; a < 3; ++a) {
          site[a] = static_cast<double>(cell[a]) + lattice_noise(cell, options_.seed, a);
        }
        if ((site - scaled).squaredNorm() < (sites[nearest] - scaled).squaredNorm()) {
          nearest = count;
        }
        ++count;
      }
    }
  }
  const Vec3& own = sites[nearest];
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < count; ++s) {
    const Vec3 apart = sites[s] - own;
    const double length = apart.norm();
    if (!(length > 0)) continue;
    distance = std::min(distance, (0.5 * (sites[s] + own) - scaled).dot(apart) / length);
  }
  return size * distance;
}

double StrengthField::at(const Vec3& point) const {
  switch (options_.kind) {
    case StrengthKind::homogeneous:
      break;
    case StrengthKind::random: {
      const double g = gaussian(point) / std::numbers::sqrt2;
      // -ln(1 - Phi) without cancellation in either tail.
      const double hazard =
          g > 0 ? -std::log(0.5 * std::erfc(g)) : -std::log1p(-0.5 * std::erfc(-g));
      return weibull_scale_ * std::pow(hazard, 1 / options_.weibull_modulus);
    }
    case StrengthKind::layered: {
      const double layer = std::floor(point.dot(layer_axis_) / options_.thickness);
      const bool weak = std::fmod(layer, 2) != 0;
      return weak ? options_.ratio * options_.mean : options_.mean;
    }
    case StrengthKind::grain: {
      const double share = std::min(1.0, 2 * boundary_distance(point) / options_.boundary_width);
      return options_.mean * (options_.ratio + (1 - options_.ratio) * share);
    }
  }
  return options_.mean;
}

}  // namespace fracbench::bem
