#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/breakable.h"
#include "core/context.h"
#include "core/fragments.h"
#include "core/impact.h"
#include "core/target.h"
#include "core/trajectory.h"
#include "scenarios/scenario.h"

namespace fracbench {

/// How well one replacement of a body by its pieces kept what must be kept, relative to the body's
/// own momentum, angular momentum and energy scale.
struct Replacement {
  double time = 0;                    ///< s
  double momentum_error = 0;          ///< |p_after - p_before| / scale
  double angular_momentum_error = 0;  ///< |L_after - L_before| / scale, about the body's centre
  double energy_ratio = 1;            ///< kinetic energy after over before (1 where both are 0)
};

struct SceneResult {
  /// One for each break, in order of time; empty: the target did not break.
  std::vector<Impact> impacts;
  /// The strongest impact that was tested and did not break the target, if there was a collision.
  std::optional<Impact> unbroken;
  /// What is there at the end, in the frame of the target; the target itself where it did not
  /// break.
  Fragments fragments;
  Trajectory trajectory;
  std::vector<Replacement> replacements;
};

/// Runs the scene. Each time the break test fires for a body that can break, the step is rewound,
/// the body replaced by its pieces and the step redone. Times the stages "rigid_body" and
/// "contact_capture" itself; the method's own stages go between them.
/// Throws MethodFailure and Cancelled from the method.
SceneResult run_scene(const Scenario& scenario, const Target& target,
                      std::shared_ptr<const Breakable> breakable, Context& context);

}  // namespace fracbench
