#include "scenarios/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/error.h"
#include "geometry/measures.h"
#include "scenarios/break_test.h"
#include "scenarios/first_impact.h"
#include "scenarios/given_impact.h"
#include "scenarios/scene_bodies.h"

namespace fracbench {

namespace {

// Pieces that break again in the redone step start the next round. A method whose pieces always
// break again would never end.
constexpr int kMaxRoundsPerStep = 16;

void keep_stronger(std::optional<Impact>& strongest, Impact impact) {
  if (!strongest || impact.break_test.total_impulse > strongest->break_test.total_impulse) {
    strongest = std::move(impact);
  }
}

struct Broken {
  int solid = -1;
  Impact impact;
  std::vector<Piece> pieces;
};

class SceneRun {
 public:
  SceneRun(const Scenario& scenario, SceneBodies& bodies, Context& context)
      : scenario_(scenario), bodies_(bodies), context_(context) {}

  void step(int frame) {
    const double time = (frame - 1) * scenario_.time_step;
    std::set<int> stays_whole;
    for (int round = 0;; ++round) {
      const std::vector<BodyContact> contacts = advance();
      if (contacts.empty() || round == kMaxRoundsPerStep) return;
      std::vector<Broken> broken = break_solids(contacts, time, stays_whole);
      if (broken.empty()) return;
      const auto stage = context_.timer.stage("rigid_body");
      bodies_.rewind();
      for (Broken& body : broken) {
        result.replacements.push_back(bodies_.replace(body.solid, std::move(body.pieces), time));
        result.impacts.push_back(std::move(body.impact));
      }
    }
  }

  /// By the impulses that are given; before the first step.
  void break_by_given_impulses(const Target& target) {
    const auto& [body, solid] = *bodies_.solids().begin();
    Impact impact = impact_of(target, scenario_.impulses, scenario_.break_test);
    std::vector<Piece> pieces;
    if (solid.breakable != nullptr) pieces = solid.breakable->fracture(impact, context_);
    if (pieces.size() < 2) {
      result.unbroken = std::move(impact);
      return;
    }
    const auto stage = context_.timer.stage("rigid_body");
    result.replacements.push_back(bodies_.replace(body, std::move(pieces), 0));
    result.impacts.push_back(std::move(impact));
  }

  SceneResult result;

 private:
  std::vector<BodyContact> advance() {
    const auto stage = context_.timer.stage("rigid_body");
    return bodies_.advance();
  }

  std::vector<Broken> break_solids(const std::vector<BodyContact>& contacts, double time,
                                   std::set<int>& stays_whole) {
    std::vector<Broken> broken;
    for (const auto& [body, solid] : bodies_.solids()) {
      const bool is_target = solid.fragment.piece < 0;
      if (solid.breakable == nullptr || stays_whole.contains(body)) continue;
      std::optional<Impact> impact = capture(body, contacts, time);
      if (!impact) continue;
      std::vector<Piece> pieces;
      if (breaks(scenario_.break_test, impact->break_test, scenario_.material)) {
        pieces = solid.breakable->fracture(*impact, context_);
      }
      if (pieces.size() > 1) {
        broken.push_back({body, std::move(*impact), std::move(pieces)});
      } else {
        stays_whole.insert(body);
        if (is_target) keep_stronger(result.unbroken, std::move(*impact));
      }
    }
    return broken;
  }

  std::optional<Impact> capture(int body, const std::vector<BodyContact>& contacts, double time) {
    const auto stage = context_.timer.stage("contact_capture");
    return bodies_.impact_on(body, contacts, time);
  }

  const Scenario& scenario_;
  SceneBodies& bodies_;
  Context& context_;
};

/// Throws InputError where the target is no solid.
std::shared_ptr<const SurfaceTree> surface_of(const Target& target) {
  if (target.mesh.empty() || !(volume(target.mesh) > 0)) {
    throw InputError(
        fmt::format("target '{}' has no volume: it must be a closed mesh whose faces look outwards",
                    target.name));
  }
  return std::make_shared<SurfaceTree>(target.mesh);
}

std::optional<FirstImpact> first_impact(const Scenario& scenario, const Target& target,
                                        const std::shared_ptr<const SurfaceTree>& surface,
                                        Context& context) {
  const auto stage = context.timer.stage("rigid_body");
  if (!scenario.impulses.empty()) {
    return FirstImpact{.impact = impact_of(target, scenario.impulses, scenario.break_test),
                       .breaks = true};
  }
  SceneBodies bodies(scenario, target, surface, nullptr);
  const int target_body = bodies.solids().begin()->first;
  std::optional<Impact> strongest;
  for (int frame = 1; frame <= scenario.frames; ++frame) {
    context.stop_if_asked();
    const std::vector<BodyContact> contacts = bodies.advance();
    if (contacts.empty()) continue;
    const auto capturing = context.timer.stage("contact_capture");
    std::optional<Impact> impact =
        bodies.impact_on(target_body, contacts, (frame - 1) * scenario.time_step);
    if (!impact) continue;
    if (breaks(scenario.break_test, impact->break_test, scenario.material)) {
      return FirstImpact{.impact = std::move(*impact), .breaks = true};
    }
    keep_stronger(strongest, std::move(*impact));
  }
  if (!strongest) return std::nullopt;
  return FirstImpact{.impact = std::move(*strongest), .breaks = false};
}

}  // namespace

SceneResult run_scene(const Scenario& scenario, const Target& target,
                      std::shared_ptr<const Breakable> breakable, Context& context) {
  std::optional<SceneBodies> bodies;
  {
    const auto stage = context.timer.stage("rigid_body");
    bodies.emplace(scenario, target, surface_of(target), std::move(breakable));
    bodies->record(0);
  }
  SceneRun run(scenario, *bodies, context);
  if (!scenario.impulses.empty()) run.break_by_given_impulses(target);
  for (int frame = 1; frame <= scenario.frames; ++frame) {
    context.stop_if_asked();
    run.step(frame);
    bodies->record(frame);
    context.progress.update("rigid-body scene", static_cast<double>(frame) / scenario.frames);
  }
  run.result.fragments = bodies->fragments();
  run.result.trajectory = bodies->take_trajectory();
  return std::move(run.result);
}

std::optional<FirstImpact> find_first_impact(const Scenario& scenario, const Target& target,
                                             Context& context) {
  return first_impact(scenario, target, surface_of(target), context);
}

std::vector<std::optional<FirstImpact>> find_first_impacts(std::span<const Scenario> scenarios,
                                                           const Target& target, Context& context) {
  const std::shared_ptr<const SurfaceTree> surface = surface_of(target);
  std::vector<std::optional<FirstImpact>> found;
  for (const Scenario& scenario : scenarios) {
    found.push_back(first_impact(scenario, target, surface, context));
  }
  return found;
}

}  // namespace fracbench
