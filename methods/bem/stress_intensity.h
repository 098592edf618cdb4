#pragma once

#include <span>
#include <vector>

#include "core/material.h"
#include "core/vec3.h"
#include "methods/bem/crack_sheet.h"

namespace fracbench::bem {

/// Stress intensities from the opening `opening` (m, upper side minus lower side) at the distance
/// `distance` (m) behind the front, by displacement correlation:
/// K_I = mu / (4 (1 - nu)) sqrt(2 pi / r) w.normal, K_II likewise with w.forward,
/// K_III = mu / 4 sqrt(2 pi / r) w.tangent.
StressIntensity displacement_correlation(const Vec3& opening, double distance,
                                         const FrontFrame& frame, const Material& material);

/// Its inverse: the opening (m) at `distance` behind a front of stress intensity `k`.
Vec3 opening_from_stress_intensity(const StressIntensity& k, double distance,
                                   const FrontFrame& frame, const Material& material);

/// Stress intensities at every boundary vertex from the opening at the sheet's vertices (m,
/// parallel to `sheet.mesh.vertices`), 0 where the state is not `advancing`. The opening is read
/// along the cut of the sheet with the plane normal to the front, at 2 and 3 local edge lengths
/// behind it (less on a small crack), and divided by the profile sqrt(r (1 - r / L)): its first
/// term is the displacement correlation, its second is exact for a penny. L is the length of the
/// cut, or twice that where its far end is open (a mouth). With a mouth the quotient grows about as
/// r^2 (for an edge crack by 30 % up to the mouth): its value there serves to take that out.
/// Throws as front_frames.
std::vector<StressIntensity> stress_intensity_from_opening(const CrackSheet& sheet,
                                                           std::span<const Vec3> opening,
                                                           const Material& material);

/// The opening at the sheet's vertices (m) from the stress intensities at its boundary, by the
/// inverse correlation from the nearest advancing boundary vertex; 0 where nothing advances.
std::vector<Vec3> opening_from_front(const CrackSheet& sheet, std::span<const StressIntensity> k,
                                     const Material& material);

/// The factors of the `fast` formula, for the three modes.
struct FastFactors {
  double mode_1 = 1.1215;
  double mode_2 = 1.1215;
  double mode_3 = 1.1215;

  /// 1.1215 for all modes: the edge crack in a half-plane (Hahn and Wojtan 2016). It gives 1.76
  /// times the stress intensity of a penny crack and about 1.35 times that of a half-penny.
  static FastFactors authors() { return {}; }
  /// Exact for a penny crack: 2 / pi, 4 / (pi (2 - nu)) and 4 (1 - nu) / (pi (2 - nu)).
  static FastFactors calibrated(double poisson_ratio);
};

/// `fast` stress intensity: K = factor sigma (pi A)^(1/4), sigma the traction on the crack's plane
/// (Pa, of the uncracked body) split into modes by the frame, A the crack's area (m^2).
StressIntensity fast_stress_intensity(const Mat3& stress, double crack_area,
                                      const FrontFrame& frame, const FastFactors& factors);

}  // namespace fracbench::bem
