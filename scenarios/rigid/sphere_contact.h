#pragma once

#include <vector>

#include "scenarios/rigid/surface_tree.h"

class btCollisionDispatcher;

namespace fracbench {

/// Gaps and overlaps below this count as touching, m.
inline constexpr double kTouch = 1e-6;

/// Where a ball touches a solid, in the frame of the solid's mesh.
struct SphereContact {
  Vec3 point;      ///< on the solid's surface
  Vec3 normal;     ///< unit, from the solid towards the ball's centre
  double gap = 0;  ///< m; negative: overlap
};

/// The places where a ball at `center` touches the surface (gap at most `reach`), nearest first:
/// the nearest point of the surface, then the next one that is seen from the ball's centre at more
/// than 35 degrees from those before, and so on, at most four. The number of places thus depends on
/// the shape, not on how finely its mesh is divided.
std::vector<SphereContact> sphere_contacts(const SurfaceTree& surface, const Vec3& center,
                                           double radius, double reach = 2 * kTouch);

/// What a collision object's user pointer must point to where it is a solid or a ball.
struct ContactSurface {
  int body = -1;                         ///< number in the world
  const SurfaceTree* surface = nullptr;  ///< null: a ball
  Pose mesh_from_body;                   ///< x_mesh = mesh_from_body.to_world(x_body)
  double radius = 0;                     ///< of a ball, m
};

/// Makes balls collide with the true surface of solids instead of with their convex parts.
void register_sphere_contact(btCollisionDispatcher& dispatcher);

}  // namespace fracbench
