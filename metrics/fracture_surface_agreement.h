#pragma once

#include <optional>

#include "core/fragments.h"
#include "core/random.h"

namespace fracbench {

/// How far two fractures of one body are apart, m.
struct FractureSurfaceAgreement {
  /// Mean distance of a point of one fracture surface to the other one; mean of both ways.
  double chamfer = 0;
  /// 95 % of the points of one are nearer to the other than this; the larger of both ways.
  double hausdorff_95 = 0;
};

/// From points drawn evenly by area. Nothing where one of them has no fracture surface.
std::optional<FractureSurfaceAgreement> fracture_surface_agreement(const Fragments& a,
                                                                   const Fragments& b, int samples,
                                                                   Random& random);

/// Each fragment is matched with the one of the other fracture whose surface has the least Chamfer
/// distance from its own; mean of these distances with volumes as weights; mean of both ways, m.
/// Points are drawn evenly by area. Nothing where one of them has no fragments.
std::optional<double> fragment_chamfer(const Fragments& a, const Fragments& b, int samples,
                                       Random& random);

}  // namespace fracbench
