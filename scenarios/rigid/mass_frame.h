#pragma once

#include "core/impact.h"
#include "core/vec3.h"
#include "geometry/measures.h"

namespace fracbench {

/// Mass of a solid, and where its principal frame lies in the frame of its mesh. A rigid-body
/// engine wants bodies at their centre of mass with a diagonal inertia:
///   x_mesh = axes * x_body + center.
struct MassFrame {
  double mass = 0;  ///< kg
  Vec3 center = Vec3::Zero();
  Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();
  Vec3 inertia = Vec3::Zero();  ///< principal moments, kg m^2

  Vec3 to_body(const Vec3& mesh_point) const {
    return axes.conjugate() * Vec3(mesh_point - center);
  }
  /// Where the body frame is when the mesh frame is at `mesh_pose`, and the other way round.
  Pose body_pose(const Pose& mesh_pose) const;
  Pose mesh_pose(const Pose& body_pose) const;
  /// Inertia about the centre of mass in world axes, kg m^2.
  Mat3 world_inertia(const Pose& mesh_pose) const;
};

/// Volume and density must be positive.
MassFrame mass_frame(const MassProperties& properties, double density);

/// Velocity of the point of a body that is at `world_point` now, m / s.
Vec3 velocity_at(const BodyState& state, const MassFrame& frame, const Vec3& world_point);

}  // namespace fracbench
