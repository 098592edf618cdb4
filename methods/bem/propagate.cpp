#include "methods/bem/propagate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "methods/bem/growth_law.h"

namespace fracbench::bem {
namespace {

// rad in a step, where the stress does not answer to the crack: through stress that turns faster
// than a front can, it would else curl up into crumbs.
constexpr double kMostTurn = 0.25;

FrontMotion motion_of(const StressIntensity& k, double last_turn, double kink_share,
                      bool stress_changes, const PropagationOptions& options) {
  const double nu = options.material.poisson_ratio;
  FrontMotion motion;
  motion.angle = kink_share * kink_angle(k, nu);
  motion.speed = crack_speed(effective_stress_intensity(k, nu), options.material);
  // Where the faces are pressed together in every plane, kinks would only turn the front to and
  // fro: it goes straight on.
  if (motion.angle * last_turn < 0) motion.angle *= k.mode_1 > 0 ? 0.5 : 0;
  if (!stress_changes) motion.angle = std::clamp(motion.angle, -kMostTurn, kMostTurn);
  return motion;
}

// A crack that has swept more sections of the body's box than this (its surface has about two
// triangles for each square of the marker spacing) curls up without end.
constexpr double kMostSections = 1.5;

class Run {
 public:
  Run(CutLinks& links, const FractureModel& model, const PropagationOptions& options,
      Context& context)
      : space_(links), model_(model), options_(options), context_(context) {
    growth_.mesh_size = options.mesh_size;
    kink_share_ = options.kink_share > 0 ? options.kink_share : model.stress_changes ? 1 : 0.5;
    growth_.spacing = std::min(links.spacing(), options.mesh_size / 5);
    const auto& size = links.voxels().size;
    const double section =
        std::max({1.0 * size[0] * size[1], 1.0 * size[1] * size[2], 1.0 * size[2] * size[0]}) *
        std::pow(links.spacing() / growth_.spacing, 2);
    most_triangles_ = static_cast<std::size_t>(2 * kMostSections * section);
  }

  void take(std::vector<Crack> inherited) {
    for (const Crack& crack : inherited) {
      const auto id = static_cast<std::int32_t>(result_.cracks.size());
      if (auto part = inherit(crack, id, space_, growth_)) add(std::move(*part));
    }
  }

  void start_cracks(const StrengthField& strength);
  void step(double duration);
  bool moves() const;
  Propagation finish();

  PropagationReport& report() { return result_.report; }

 private:
  /// The crack stands still from here on.
  void stop(std::size_t crack, std::string_view reason) {
    if (stands_[crack]) return;
    stands_[crack] = 1;
    for (FrontMarker& m : result_.cracks[crack].front) m.speed = 0;
    result_.report.failures.push_back(fmt::format("crack {}: {}", crack, reason));
  }
  void add(Crack crack) {
    result_.cracks.push_back(std::move(crack));
    stands_.push_back(0);
  }
  void steer_all();
  std::vector<CrackSheet> sheets() const {
    std::vector<CrackSheet> all;
    for (const Crack& crack : result_.cracks) all.push_back(crack.sheet);
    return all;
  }

  CrackSpace space_;
  const FractureModel& model_;
  const PropagationOptions& options_;
  Context& context_;
  GrowthOptions growth_;
  double kink_share_ = 1;
  std::size_t most_triangles_ = 0;  ///< of a crack's surface, before it counts as broken down
  Propagation result_;
  std::vector<std::uint8_t> stands_;  ///< cracks that broke down
};

void Run::start_cracks(const StrengthField& strength) {
  PropagationReport& report = result_.report;
  const int left = options_.max_cracks - static_cast<int>(report.new_cracks);
  if (left <= 0) return;
  std::vector<Vec3> occupied;
  for (const Crack& crack : result_.cracks) {
    occupied.insert(occupied.end(), crack.surface.vertices.begin(), crack.surface.vertices.end());
  }
  InitiationOptions options;
  options.max_cracks = left;
  options.compressive_factor = options_.material.compressive_factor;
  options.parity = options_.parity;
  options.min_distance = options_.min_distance > 0 ? options_.min_distance : options_.mesh_size;
  for (const CrackSeed& seed :
       initiate(model_.surface_stress(sheets()), strength, occupied, options)) {
    const auto id = static_cast<std::int32_t>(result_.cracks.size());
    if (auto seeded = seed_crack(seed, id, space_, growth_)) {
      add(std::move(seeded->crack));
      report.area += seeded->area;
      ++report.new_cracks;
    } else {
      ++report.failed_seeds;
    }
  }
}

void Run::steer_all() {
  const auto intensities = model_.stress_intensity(sheets());
  if (intensities.size() != result_.cracks.size()) {
    throw MethodFailure(fmt::format("stress intensities of {} cracks, of {}", intensities.size(),
                                    result_.cracks.size()));
  }
  for (std::size_t c = 0; c < result_.cracks.size(); ++c) {
    Crack& crack = result_.cracks[c];
    std::vector<FrontMotion> motions;
    if (intensities[c].size() != crack.sheet.boundary.size()) {
      throw MethodFailure(
          fmt::format("stress intensities at {} vertices of a crack's boundary of {}",
                      intensities[c].size(), crack.sheet.boundary.size()));
    }
    for (const FrontMarker& marker : crack.front) {
      if (marker.coarse < 0) continue;
      motions.push_back(motion_of(intensities[c][motions.size()], marker.turn, kink_share_,
                                  model_.stress_changes, options_));
    }
    for (const FrontMotion& motion : motions) {
      if (!std::isfinite(motion.angle) || !std::isfinite(motion.speed)) {
        stop(c, "its stress intensity is no number");
      }
    }
    if (stands_[c]) motions.assign(motions.size(), FrontMotion{});
    steer(crack, motions, growth_);
  }
}

bool Run::moves() const {
  for (const Crack& crack : result_.cracks) {
    for (const FrontMarker& m : crack.front) {
      if (m.state == FrontState::advancing && m.speed > 0) return true;
    }
  }
  return false;
}

void Run::step(double duration) {
  steer_all();
  double fastest = 0;
  for (const Crack& crack : result_.cracks) {
    for (const FrontMarker& m : crack.front) {
      if (m.state == FrontState::advancing) fastest = std::max(fastest, m.speed);
    }
  }
  // All cracks advance together, in moves of a marker spacing, so that who meets whom does not
  // depend on their order by more than that.
  const int moves = static_cast<int>(std::ceil(fastest * duration / growth_.spacing - 1e-9));
  for (int k = 0; k < moves; ++k) {
    context_.stop_if_asked();
    for (std::size_t c = 0; c < result_.cracks.size(); ++c) {
      if (stands_[c]) continue;
      Crack& crack = result_.cracks[c];
      result_.report.area +=
          advance(crack, static_cast<std::int32_t>(c), duration / moves, space_, growth_);
      if (crack.surface.faces.size() > most_triangles_) {
        stop(c, "it has swept several times the section of the body's box");
      }
    }
  }
  for (std::size_t c = 0; c < result_.cracks.size(); ++c) {
    Crack& crack = result_.cracks[c];
    if (stands_[c]) continue;
    Crack before = crack;
    try {
      follow_front(crack, growth_);
    } catch (const MethodFailure& failure) {
      crack = std::move(before);
      stop(c, failure.what());
    }
  }
  ++result_.report.steps;
  result_.report.time += duration;
}

Propagation Run::finish() {
  PropagationReport& report = result_.report;
  for (const Crack& crack : result_.cracks) {
    for (const FrontMarker& m : crack.front) {
      if (m.state == FrontState::at_surface) ++report.at_surface;
      if (m.state == FrontState::at_crack) ++report.at_crack;
      if (m.state == FrontState::advancing) ++(m.speed > 0 ? report.advancing : report.arrested);
    }
  }
  if (result_.cracks.empty()) {
    report.end = PropagationEnd::no_crack;
  } else if (report.advancing > 0) {
    report.end = PropagationEnd::time_over;
  } else {
    report.end = report.arrested > 0 ? PropagationEnd::arrested : PropagationEnd::complete;
  }
  return std::move(result_);
}

}  // namespace

Propagation propagate(std::vector<Crack> inherited, CutLinks& links, const StrengthField& strength,
                      const FractureModel& model, const PropagationOptions& options,
                      Context& context) {
  Run run(links, model, options, context);
  run.take(std::move(inherited));
  const double dt = options.mesh_size / rayleigh_speed(options.material);
  const int steps = static_cast<int>(std::ceil(options.duration / dt - 1e-9));
  for (int s = 0; s < steps; ++s) {
    context.stop_if_asked();
    context.progress.update("crack growth", static_cast<double>(s) / steps);
    if (s == 0 || model.stress_changes) run.start_cracks(strength);
    run.step(std::min(dt, options.duration - s * dt));
    if (!run.moves()) break;
  }
  return run.finish();
}

}  // namespace fracbench::bem
