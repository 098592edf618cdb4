#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/context.h"
#include "core/material.h"
#include "methods/bem/conform_cracks.h"
#include "methods/bem/crack_system.h"
#include "methods/bem/initiation.h"

namespace fracbench::bem {

/// What a FullModel did, for records.
struct FullModelReport {
  int solves = 0;
  /// Over all solves: cracks at the surface, and those of them without a conforming mouth (their
  /// sheets overshoot the surface: a half-penny then has 8 % too much stress intensity at its
  /// deepest point and half of it beside the surface).
  std::int64_t cracks_at_surface = 0;
  std::int64_t overshooting = 0;
  /// Solves whose conforming system could not be factored: repeated with all sheets overshooting.
  int repeated = 0;
  /// Components of openings, over all solves, held at 0 (see CrackedSolution::held).
  std::size_t held = 0;
  std::string repeated_for = {};  ///< the reason of the last one
  std::size_t most_unknowns = 0;
};

/// The `full` model (Hahn and Wojtan 2015): the loaded body solved with the openings of all its
/// cracks, and the stress intensities taken from them by displacement correlation. Holds the
/// operator between calls, so that only what changed is assembled. Keeps a reference to `context`.
class FullModel {
 public:
  /// `body` closed; `stress`: of the body without cracks under its load, and `on_surface` the same
  /// on each of its triangles. Throws InputError where those are for another number of triangles.
  FullModel(TriangleMesh body, StressField stress, std::vector<Mat3> on_surface,
            const Material& material, Context& context);

  /// As StressIntensityModel: at every boundary vertex of every crack, 0 where it does not advance.
  /// Throws MethodFailure where the system cannot be factored.
  std::vector<std::vector<StressIntensity>> stress_intensity(std::span<const CrackSheet> cracks);

  /// The stress on the body's surface with these cracks in it, element by element of the surface
  /// into which the mouths are carved.
  SurfaceStress surface_stress(std::span<const CrackSheet> cracks);

  const FullModelReport& report() const { return report_; }
  /// Of the last solve: unknowns, and vertices whose rows were assembled anew.
  std::size_t last_unknowns() const { return system_.unknowns(); }
  std::size_t last_assembled() const { return system_.assembled_vertices(); }

 private:
  struct State {
    std::vector<CrackSheet> cracks;  ///< as given
    ConformedCracks conformed;
    CrackedSolution solution;
  };
  const State& solve(std::span<const CrackSheet> cracks);
  State solve_conformed(std::span<const CrackSheet> cracks, bool conform);

  TriangleMesh body_;
  std::vector<Mat3> on_surface_;
  Material material_;
  Context* context_;
  CrackSystem system_;
  std::optional<State> last_;
  FullModelReport report_;
};

}  // namespace fracbench::bem
