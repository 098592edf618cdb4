#pragma once

#include "core/material.h"
#include "core/options.h"
#include "methods/bem/load_balance.h"
#include "methods/bem/strength_field.h"

namespace fracbench::bem {

enum class Mode {
  fast,  ///< stress at the fronts from one initial solve (Hahn and Wojtan 2016)
  full   ///< the openings of all cracks are solved for in every step (Hahn and Wojtan 2015)
};

/// The options of the method, as values.
struct Settings {
  int triangles = 1500;
  double voxel = 0.01;      ///< m
  double crack_mesh = 0.1;  ///< m
  int max_cracks = 10;
  Mode mode = Mode::fast;
  bool calibrated = false;  ///< factor of the `fast` stress intensity: exact for a penny crack
  LoadBalance balance = LoadBalance::min_norm;
  StrengthOptions strength;  ///< mean and seed are filled in at the break
  bool parity = false;
  double smallest_fragment = 1e-6;  ///< of the body's volume
  double smallest_voxels = 30;
  double hull_volume = 0.005;       ///< of the target's volume; under parity only
  double refracture_volume = 0.02;  ///< of the target's volume
};

OptionsSchema options_schema();

/// Throws InputError where options contradict each other.
Settings settings_from(const Options& options);

/// Throws InputError where the material is out of the range in which the method has a meaning:
/// E > 0, 0 <= nu < 0.5, rho > 0, strength > 0, toughness > 0, compressive factor >= 1.
void check_material(const Material& material);

}  // namespace fracbench::bem
