#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/vec3.h"

namespace fracbench::bem {

enum class StrengthKind : std::uint8_t { homogeneous, random, layered, grain };

/// The kind named `name` ("homogeneous", "random", "layered", "grain"). Throws InputError.
StrengthKind strength_kind(std::string_view name);

struct StrengthOptions {
  StrengthKind kind = StrengthKind::homogeneous;
  double mean = 7.6e5;     ///< Pa: the strength itself, the mean of `random`, of the odd layers
                           ///< and inside the grains
  std::uint64_t seed = 0;  ///< of `random` and `grain`

  double weibull_modulus = 10;      ///< of `random`: the shape parameter m
  double correlation_length = 0.2;  ///< m, of `random`: must exceed the size of the elements, or
                                    ///< refining the mesh finds ever weaker points

  Vec3 direction = Vec3(0, 0, 1);  ///< normal of the layers
  double thickness = 0.1;          ///< m, of one layer
  double grain_size = 0.3;         ///< m, mean distance of neighbouring grains
  double boundary_width = 0.05;    ///< m: a boundary is weak up to half of this on either side
  /// Strength of every second layer, and of the boundaries between grains, over `mean`.
  double ratio = 0.5;
};

/// The tensile strength of a body as a function of position, Pa. It depends on the position and
/// the options only, never on a mesh or a grid, so that one seed gives the same weak spots at
/// every resolution.
///
/// `random`: a Gaussian field g of zero mean, unit variance and correlation exp(-r^2 / (2 l^2)),
/// as a sum of random Fourier modes (Shinozuka and Deodatis 1996; Rahimi and Recht 2007), turned
/// into a Weibull distribution of its quantiles: S = s (-ln(1 - Phi(g)))^(1/m), where the scale s
/// gives the mean. `layered`: slabs of equal thickness, every second one weaker. `grain`: Voronoi
/// cells of one random point in each cube of a lattice; the strength rises linearly from
/// ratio * mean on the boundary to the mean at half its width.
class StrengthField {
 public:
  /// Throws InputError for a number out of its range.
  explicit StrengthField(const StrengthOptions& options);

  double at(const Vec3& point) const;

  /// The Gaussian field behind `random`.
  double gaussian(const Vec3& point) const;
  /// Distance (m) from the nearest boundary between grains.
  double boundary_distance(const Vec3& point) const;

 private:
  struct Mode {
    Vec3 wave;     ///< 1/m
    double phase;  ///< rad
  };

  StrengthOptions options_;
  Vec3 layer_axis_ = Vec3::Zero();
  double weibull_scale_ = 0;  ///< Pa
  std::vector<Mode> modes_;
};

}  // namespace fracbench::bem
