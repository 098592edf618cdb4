#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/context.h"
#include "core/material.h"
#include "methods/bem/crack_growth.h"

namespace fracbench::bem {

/// What drives cracks through a body.
struct FractureModel {
  /// Stress on the body's surface with these cracks in it.
  std::function<SurfaceStress(std::span<const CrackSheet>)> surface_stress;
  /// Stress intensities at the fronts.
  StressIntensityModel stress_intensity;
  /// Whether the surface stress changes as the cracks grow: then more cracks may start in every
  /// step, else all start at the beginning.
  bool stress_changes = false;
};

struct PropagationOptions {
  Material material;
  int max_cracks = 10;      ///< new ones, those that the body has already not counted
  double mesh_size = 0.1;   ///< h, m: edge length of the crack sheets
  double duration = 0;      ///< s: the shorter of the rigid-body step and the contact's
  double min_distance = 0;  ///< m: see InitiationOptions; 0: mesh_size
  bool parity = false;      ///< see InitiationOptions
  /// Share of the kink angle by which a front turns in a step; 0: 1 where the model's stress
  /// changes with the cracks, else 1/2. The hoop stress criterion turns a tip by -2 K_II / K_I
  /// (small angles), after which K_II vanishes, because the shear at a kinked tip falls half as
  /// fast as that on a plane which turns in a given stress. With stress intensities taken from such
  /// a plane
  /// (`fast`) a share of 1 turns the front too far, to and fro from step to step without end; 1/2
  /// is the share after which K_II vanishes. Where the stress does not change, a step turns a front
  /// by at most 0.25 rad: sharper kinks take several steps.
  double kink_share = 0;
};

enum class PropagationEnd : std::uint8_t {
  no_crack,   ///< the strength is nowhere exceeded
  time_over,  ///< fronts still advance
  complete,   ///< every front ended at the surface or at another crack
  arrested    ///< no front has the stress intensity to go on
};

struct PropagationReport {
  PropagationEnd end = PropagationEnd::no_crack;
  std::size_t new_cracks = 0;
  std::size_t failed_seeds = 0;  ///< starts whose plane cuts no voxel
  int steps = 0;
  double time = 0;  ///< s, reached
  double area = 0;  ///< m^2 inside the body, new
  /// Markers at the end. Those of `arrested` could still advance but lack stress intensity.
  std::size_t at_surface = 0, at_crack = 0, advancing = 0, arrested = 0;
  /// Cracks whose front broke down numerically, with the reason; they stand still from there on.
  std::vector<std::string> failures;
};

struct Propagation {
  std::vector<Crack> cracks;  ///< inherited ones first; their index is their name in CutLinks
  PropagationReport report;
};

/// Starts cracks where the stress exceeds the strength and lets them run through the body, in
/// steps of mesh_size / c_R until `duration`, by the laws of growth_law.h. `inherited`: cracks that
/// the body has already; they go on.
///
/// The same for any number of threads. Throws Cancelled when asked to stop.
Propagation propagate(std::vector<Crack> inherited, CutLinks& links, const StrengthField& strength,
                      const FractureModel& model, const PropagationOptions& options,
                      Context& context);

}  // namespace fracbench::bem
