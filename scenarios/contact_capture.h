#pragma once

#include <span>
#include <vector>

#include "core/impact.h"
#include "core/material.h"
#include "scenarios/break_test.h"
#include "scenarios/rigid/world.h"

namespace fracbench {

/// What a fracture method may know of a body that strikes another one.
struct StrikerBody {
  double mass = 0;    ///< kg
  double radius = 0;  ///< m; of a solid: of the ball of the same volume
  Material material;
  BodyState state;                     ///< before the step
  Vec3 center_of_mass = Vec3::Zero();  ///< in its mesh frame
};

/// The body that is struck.
struct StruckBody {
  const TriangleMesh* mesh = nullptr;
  const SurfaceTree* surface = nullptr;
  const MassFrame* frame = nullptr;
  BodyState state;         ///< before the step
  double region_size = 0;  ///< contacts nearer than this to each other are one impulse, m
};

/// The impulses that a body received in a step, merged by region and sorted by strength, with the
/// strikers in the same order. A region is all contacts with one striker within `region_size` of
/// the strongest one; its impulse is their vector sum, its point their impulse-weighted mean, moved
/// to the nearest point of the surface. So the first impulse does not depend on how many points the
/// engine returns.
struct CapturedImpulses {
  std::vector<Impulse> impulses;
  std::vector<Striker> strikers;
  std::vector<ContactSpeed> speeds;
};

/// `contacts` are those on this body alone; strikers[i] belongs to contacts[i].
CapturedImpulses capture_impulses(std::span<const BodyContact> contacts,
                                  std::span<const StrikerBody> strikers, const StruckBody& body);

}  // namespace fracbench
