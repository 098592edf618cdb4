#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/fragments.h"
#include "core/random.h"

namespace fracbench {

/// How far two fractures of one body are apart, m.
struct FractureSurfaceAgreement {
  /// Mean distance of a point of one fracture surface to the other one; mean of both ways.
  double chamfer = 0;
  /// 95 % of the points of one are nearer to the other than this; the larger of both ways.
  double hausdorff_95 = 0;
  bool operator==(const FractureSurfaceAgreement&) const = default;
};

/// How many points are drawn, evenly by area.
struct SurfaceSamples {
  int fracture_surface = 2000;
  int fragment = 200;  ///< on each
};

/// A fracture, ready to be compared with many others. Safe to use from many threads.
class SampledFracture {
 public:
  SampledFracture(const Fragments& fragments, const SurfaceSamples& samples, Random& random);
  ~SampledFracture();
  SampledFracture(SampledFracture&&) noexcept;
  SampledFracture& operator=(SampledFracture&&) noexcept;

  /// Nothing where one of them has no fracture surface.
  std::optional<FractureSurfaceAgreement> surface_agreement(const SampledFracture& other) const;

  /// Each fragment is matched with the one of the other fracture whose surface has the least
  /// Chamfer distance from its own; mean of these distances with volumes as weights; mean of both
  /// ways, m. Nothing where one of them has no fragments.
  std::optional<double> fragment_chamfer(const SampledFracture& other) const;

 private:
  struct Sampled;
  std::unique_ptr<Sampled> surface_;  ///< null: there is none
  std::vector<Sampled> fragments_;
};

}  // namespace fracbench
