#include "scenarios/scene_bodies.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "geometry/measures.h"
#include "scenarios/break_test.h"
#include "scenarios/contact_capture.h"
#include "scenarios/replacement.h"

namespace fracbench {

namespace {

// Lengths as shares of the target's longest side.
constexpr double kRegionShare = 0.05;     // contacts nearer than this are one impulse
constexpr double kGapShare = 0.002;       // how far colliders stay within their solids
constexpr double kToleranceShare = 0.02;  // concavities that colliders may fill

std::string text(const Vec3& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x(), v.y(), v.z());
}

/// How often the surface goes around the point: 1 inside of a closed mesh, 0 outside (van Oosterom
/// and Strackee, "The solid angle of a plane triangle", 1983).
double winding_number(const TriangleMesh& mesh, const Vec3& point) {
  double angle = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 a = mesh.corner(f, 0) - point;
    const Vec3 b = mesh.corner(f, 1) - point;
    const Vec3 c = mesh.corner(f, 2) - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

void require_free_start(const Scenario& scenario, const SceneBodies::Solid& target,
                        std::string_view name) {
  for (std::size_t i = 0; i < scenario.balls.size(); ++i) {
    const Ball& ball = scenario.balls[i];
    for (std::size_t j = 0; j < i; ++j) {
      if ((ball.position - scenario.balls[j].position).norm() <
          ball.radius + scenario.balls[j].radius) {
        throw InputError(
            fmt::format("scenario '{}': balls {} and {} overlap at the start; move one of them",
                        scenario.name, j, i));
      }
    }
    const MassFrame& frame = target.rigid.frame;
    const double reach = target.rigid.surface->farthest_from(frame.center);
    if ((ball.position - frame.center).norm() > reach + ball.radius) continue;
    const double distance = target.rigid.surface->nearest(ball.position).distance;
    if (distance < ball.radius || winding_number(target.fragment.mesh, ball.position) > 0.5) {
      throw InputError(fmt::format(
          "scenario '{}': ball {} of radius {} m starts at {} in the target '{}', whose surface is "
          "{:.4g} m from there; start it farther away",
          scenario.name, i, ball.radius, text(ball.position), name, distance));
    }
  }
}

RigidSolid rigid_solid(const TriangleMesh& mesh, std::shared_ptr<const SurfaceTree> surface,
                       const Material& material, Collider collider) {
  return {.surface = std::move(surface),
          .frame = mass_frame(mass_properties(mesh), material.density),
          .collider = std::move(collider),
          .material = material};
}

}  // namespace

SceneBodies::SceneBodies(const Scenario& scenario, const Target& target,
                         std::shared_ptr<const SurfaceTree> surface,
                         std::shared_ptr<const Breakable> breakable)
    : scenario_(scenario), size_(bounding_box(target.mesh).longest_side()), world_(size_) {
  trajectory_.frame_seconds = scenario.time_step;
  Solid solid;
  solid.fragment = {.mesh = target.mesh, .faces = {}, .piece = -1, .parent = -1, .generation = 0};
  for (std::size_t f = 0; f < target.mesh.faces.size(); ++f) {
    solid.fragment.faces.push_back({.original_face = static_cast<std::int32_t>(f)});
  }
  solid.breakable = std::move(breakable);
  solid.rigid =
      rigid_solid(target.mesh, std::move(surface), scenario.material, box_collider(target.mesh));
  require_free_start(scenario, solid, target.name);
  solid.track = new_track(Track::Kind::target, 0);
  add_solid(std::move(solid), {});
  for (const Ball& ball : scenario.balls) {
    const std::size_t track =
        new_track(Track::Kind::ball, static_cast<std::int32_t>(balls_.size()));
    balls_.push_back({.body = world_.add_ball(ball), .ball = ball, .track = track});
  }
}

void SceneBodies::add_solid(Solid solid, const BodyState& state) {
  const int body = world_.add_solid(solid.rigid, state);
  solids_.emplace(body, std::move(solid));
}

std::size_t SceneBodies::new_track(Track::Kind kind, std::int32_t index) {
  trajectory_.tracks.push_back({.kind = kind, .index = index, .first_frame = -1, .poses = {}});
  return trajectory_.tracks.size() - 1;
}

std::vector<BodyContact> SceneBodies::advance() {
  before_ = world_.save();
  states_before_.clear();
  for (const auto& [body, solid] : solids_) states_before_[body] = world_.state(body);
  for (const BallBody& ball : balls_) states_before_[ball.body] = world_.state(ball.body);
  return world_.advance(scenario_.time_step);
}

void SceneBodies::rewind() { world_.restore(*before_); }

std::optional<Impact> SceneBodies::impact_on(int solid, const std::vector<BodyContact>& contacts,
                                             double time) const {
  const Solid& struck = solids_.at(solid);
  std::vector<BodyContact> own;
  std::vector<StrikerBody> strikers;
  for (const BodyContact& contact : contacts) {
    if (contact.body != solid) continue;
    StrikerBody striker;
    striker.state = states_before_.at(contact.other);
    striker.mass = world_.frame(contact.other).mass;
    striker.center_of_mass = world_.frame(contact.other).center;
    if (const auto other = solids_.find(contact.other); other != solids_.end()) {
      striker.material = other->second.rigid.material;
      const double volume = striker.mass / striker.material.density;
      striker.radius = std::cbrt(3 * volume / (4 * std::numbers::pi));
    } else {
      for (const BallBody& ball : balls_) {
        if (ball.body != contact.other) continue;
        striker.material = ball.ball.material;
        striker.radius = ball.ball.radius;
      }
    }
    own.push_back(contact);
    strikers.push_back(striker);
  }
  const BodyState& state = states_before_.at(solid);
  CapturedImpulses captured = capture_impulses(own, strikers,
                                               {.mesh = &struck.fragment.mesh,
                                                .surface = struck.rigid.surface.get(),
                                                .frame = &struck.rigid.frame,
                                                .state = state,
                                                .region_size = kRegionShare * size_});
  if (captured.impulses.empty()) return std::nullopt;
  Impact impact;
  impact.body = state;
  impact.time = time;
  impact.time_step = scenario_.time_step;
  impact.break_test = break_test_values(captured.impulses, captured.strikers, captured.speeds,
                                        struck.rigid.material, scenario_.time_step);
  impact.overload = overload(scenario_.break_test, impact.break_test, struck.rigid.material);
  impact.fragment = struck.fragment.piece;
  impact.impulses = std::move(captured.impulses);
  impact.strikers = std::move(captured.strikers);
  return impact;
}

Replacement SceneBodies::replace(int solid, std::vector<Piece> pieces, double time) {
  const BodyState state = world_.state(solid);
  Solid broken = std::move(solids_.at(solid));
  auto faces = compose_faces(broken.fragment.faces, pieces, next_interface_);

  std::vector<RigidSolid> rigids;
  std::vector<MassFrame> frames;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const TriangleMesh& mesh = pieces[p].mesh;
    if (mesh.empty() || !(volume(mesh) > 0)) {
      throw MethodFailure(fmt::format("piece {} of {} has no volume", p, pieces.size()));
    }
    rigids.push_back(rigid_solid(
        mesh, std::make_shared<SurfaceTree>(mesh), broken.rigid.material,
        make_collider(mesh, {.gap = kGapShare * size_, .tolerance = kToleranceShare * size_})));
    frames.push_back(rigids.back().frame);
  }

  world_.remove(solid);
  solids_.erase(solid);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    Solid piece;
    piece.fragment = {.mesh = std::move(pieces[p].mesh),
                      .faces = std::move(faces[p]),
                      .piece = next_piece_++,
                      .parent = broken.fragment.piece,
                      .generation = broken.fragment.generation + 1};
    if (scenario_.refracture) piece.breakable = std::move(pieces[p].next);
    piece.rigid = std::move(rigids[p]);
    piece.track = new_track(Track::Kind::piece, piece.fragment.piece);
    add_solid(std::move(piece), piece_state(state, broken.rigid.frame, frames[p]));
  }
  return measure_replacement(time, state, broken.rigid.frame, frames);
}

void SceneBodies::record(int frame) {
  const auto append = [&](std::size_t index, int body) {
    Track& track = trajectory_.tracks[index];
    if (track.poses.empty()) track.first_frame = frame;
    track.poses.push_back(world_.state(body).pose);
  };
  for (const auto& [body, solid] : solids_) append(solid.track, body);
  for (const BallBody& ball : balls_) append(ball.track, ball.body);
}

Fragments SceneBodies::fragments() const {
  Fragments fragments;
  for (const auto& [body, solid] : solids_) fragments.push_back(solid.fragment);
  return fragments;
}

}  // namespace fracbench
