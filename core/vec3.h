#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace fracbench {

/// Points, directions and velocities. Lengths are metres in the normalised frame, where a body's
/// longest side is 1.9 unless the suite says otherwise.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// A rigid placement: x_world = orientation * x_local + position.
struct Pose {
  Vec3 position = Vec3::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  Vec3 to_world(const Vec3& local) const { return orientation * local + position; }
  Vec3 to_local(const Vec3& world) const { return orientation.conjugate() * (world - position); }
};

}  // namespace fracbench
