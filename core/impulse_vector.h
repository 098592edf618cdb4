#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/impact.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// The scaling of impulses that a learned model is made with, and has to be used with.
struct ImpulseScaling {
  Vec3 centre = Vec3::Zero();  ///< of the target's bounding box, m
  double half_side = 1;        ///< half of that box's longest side, m
  double max_impulse = 1;      ///< I_max, N s

  bool operator==(const ImpulseScaling&) const = default;
};

/// As files hold it: centre, half side, I_max.
inline constexpr std::size_t kScalingValues = 5;
std::array<double, kScalingValues> scaling_values(const ImpulseScaling& scaling);
ImpulseScaling scaling_of(std::span<const double, kScalingValues> values);

/// Numbers in one impulse's vector.
inline constexpr int kImpulseValues = 7;

/// Throws InputError where the mesh is empty or I_max is not positive.
ImpulseScaling impulse_scaling(const TriangleMesh& target, double max_impulse);

/// V = [p d I] of the `features` strongest impulses, one after the other (section 4.2.1 of the
/// DeepFracture paper): point from the centre by half the longest side, unit direction, and
/// 2 I / I_max - 1. Where there are fewer impulses, the rest is [0 0 -1], an impulse of no
/// strength.
std::vector<float> impulse_vector(const Impact& impact, const ImpulseScaling& scaling,
                                  int features = 1);

}  // namespace fracbench
