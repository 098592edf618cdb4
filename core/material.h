#pragma once

namespace fracbench {

/// Material of a body. The defaults are those of the published DeepFracture parameter files.
struct Material {
  double young_modulus = 3.1e9;   ///< E, Pa
  double poisson_ratio = 0.327;   ///< nu
  double density = 1000;          ///< rho, kg / m^3
  double strength = 7.6e5;        ///< critical stress sigma_0, Pa
  double toughness = 1e3;         ///< K_c, Pa sqrt(m)
  double compressive_factor = 6;  ///< compressive strength over tensile strength
  double friction = 0.6;          ///< Coulomb coefficient
  double restitution = 0.4;       ///< Newton's coefficient

  bool operator==(const Material&) const = default;
};

}  // namespace fracbench
