#pragma once

#include <memory>
#include <vector>

#include "core/impact.h"
#include "core/material.h"
#include "scenarios/rigid/colliders.h"
#include "scenarios/rigid/mass_frame.h"
#include "scenarios/rigid/surface_tree.h"
#include "scenarios/scenario.h"

namespace fracbench {

/// A solid as the rigid-body world wants it. All parts are in the frame of the mesh.
struct RigidSolid {
  std::shared_ptr<const SurfaceTree> surface;
  MassFrame frame;
  Collider collider;
  Material material;
};

/// An impulse that one body received from another while the world advanced.
struct BodyContact {
  int body = -1;
  int other = -1;
  Vec3 point;    ///< in the mesh frame of `body`, m
  Vec3 impulse;  ///< on `body`, friction included, in its mesh frame, N s
};

/// Rigid bodies in zero gravity (Bullet, double precision). Bodies are numbered in the order in
/// which they are added; numbers are not used again. The same calls give the same bytes.
///
/// - Balls meet the true surface of solids (sphere_contact.h), and time is cut where a ball first
///   touches one, so that no contact begins with an overlap.
/// - Solids meet each other with their convex parts. What overlaps when a solid is added may stay:
///   the engine sees only overlap beyond it, and what a pair gives up it does not get back. So
///   fragments of a body rest beside each other where they were made.
/// - Overlaps are undone by moving bodies, never by giving them velocity (split impulses), so that
///   they do not explode.
/// - Restitution and friction of a pair are the geometric means of those of the two materials.
class RigidWorld {
 public:
  /// `size`: the length that tolerances are measured by, the longest side of the target, m.
  explicit RigidWorld(double size);
  ~RigidWorld();
  RigidWorld(const RigidWorld&) = delete;
  RigidWorld& operator=(const RigidWorld&) = delete;

  int add_ball(const Ball& ball);
  int add_solid(const RigidSolid& solid, const BodyState& state);
  void remove(int body);

  /// Of the mesh frame; of the centre for a ball.
  BodyState state(int body) const;
  const MassFrame& frame(int body) const;

  /// Everything that moves, to come back to. Bodies that were added or removed in between stay so.
  struct Snapshot;
  std::shared_ptr<const Snapshot> save() const;
  void restore(const Snapshot& snapshot);

  /// Moves on by `seconds`; returns all impulses on all bodies, in order of time.
  std::vector<BodyContact> advance(double seconds);

  /// The deepest overlap of the convex parts of two solids now, beyond what was allowed, m.
  double deepest_overlap() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fracbench
