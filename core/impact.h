#pragma once

#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace fracbench {

/// One impulse that a body receives at a point of its surface, in the body's own frame (the frame
/// of its mesh). Equation (1) of the DeepFracture paper.
struct Impulse {
  Vec3 point;              ///< p, on the surface, m
  Vec3 direction;          ///< d, unit vector, the way the body is pushed
  double magnitude = 0;    ///< I, N s
  std::int32_t face = -1;  ///< face of the body's mesh that holds the point
  Vec3 normal;             ///< outward unit normal of that face
  double face_area = 0;    ///< m^2
};

/// An impulse that is known without a collision.
struct GivenImpulse {
  Vec3 point = Vec3::Zero();      ///< on the surface of the body, or near it, m
  Vec3 direction = Vec3::Zero();  ///< the way the body is pushed
  double magnitude = 0;           ///< N s
};

/// Motion of a rigid body. Velocity is that of the centre of mass.
struct BodyState {
  Pose pose;                             ///< of the mesh frame
  Vec3 velocity = Vec3::Zero();          ///< m / s
  Vec3 angular_velocity = Vec3::Zero();  ///< rad / s, world axes
};

/// The other body of a collision, as far as a fracture method needs it.
struct Striker {
  double mass = 0;           ///< kg
  double radius = 0;         ///< of curvature at the contact, m
  double young_modulus = 0;  ///< Pa
  double poisson_ratio = 0;
  Vec3 velocity = Vec3::Zero();  ///< relative to the body, body frame, m / s
};

/// The three break tests (see scenarios/break_test.h); all three are kept in the record.
struct BreakTestValues {
  double total_impulse = 0;     ///< sum of magnitudes, N s
  double balanced_force = 0;    ///< N
  double eq2_face_stress = 0;   ///< equation (2) with the hit triangle, Pa
  double eq2_patch_stress = 0;  ///< equation (2) with the contact patch, Pa
};

/// What made a body break: everything a method may look at.
struct Impact {
  std::vector<Impulse> impulses;  ///< strongest first
  std::vector<Striker> strikers;  ///< parallel to impulses
  BodyState body;                 ///< before the step in which it breaks
  double time = 0;                ///< start of that step since the scene began, s
  double time_step = 0;           ///< s
  BreakTestValues break_test;
  /// The impulse over the one at which the same blow would just break the body, by the break test
  /// of the scene; 0 where that is not known.
  double overload = 0;
  std::int32_t fragment = -1;  ///< which piece broke: -1 the target itself, else the running
                               ///< number of the piece (see Fragment::piece)
};

}  // namespace fracbench
