#include "scenarios/rigid/mass_frame.h"

#include <Eigen/Eigenvalues>

namespace fracbench {

Pose MassFrame::body_pose(const Pose& mesh_pose) const {
  return {.position = mesh_pose.to_world(center),
          .orientation = (mesh_pose.orientation * axes).normalized()};
}

Pose MassFrame::mesh_pose(const Pose& body_pose) const {
  Pose pose;
  pose.orientation = (body_pose.orientation * axes.conjugate()).normalized();
  pose.position = body_pose.position - pose.orientation * center;
  return pose;
}

Mat3 MassFrame::world_inertia(const Pose& mesh_pose) const {
  const Mat3 turn = (mesh_pose.orientation * axes).toRotationMatrix();
  return turn * inertia.asDiagonal() * turn.transpose();
}

MassFrame mass_frame(const MassProperties& properties, double density) {
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(properties.inertia);
  Mat3 axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  return {.mass = density * properties.volume,
          .center = properties.center,
          .axes = Eigen::Quaterniond(axes).normalized(),
          .inertia = density * principal.eigenvalues()};
}

Vec3 velocity_at(const BodyState& state, const MassFrame& frame, const Vec3& world_point) {
  return state.velocity +
         state.angular_velocity.cross(world_point - state.pose.to_world(frame.center));
}

}  // namespace fracbench
