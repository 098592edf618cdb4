#include "scenarios/rigid/first_touch.h"

#include <cmath>

#include "scenarios/rigid/sphere_contact.h"

namespace fracbench {

namespace {

// Grazing flights need the most: each advance then closes a part of the gap only. What is left
// after so many is a gap that closes so slowly that the engine's own step takes care of it.
constexpr int kMaxAdvances = 200;

/// Where the solid's mesh frame is after a time of free flight, as the engine integrates it.
Pose pose_after(const FlyingSolid& solid, double seconds) {
  Pose pose = solid.state.pose;
  const Vec3 center = pose.to_world(solid.frame->center) + seconds * solid.state.velocity;
  const double speed = solid.state.angular_velocity.norm();
  if (speed > 0) {
    const Eigen::AngleAxisd turn(speed * seconds, solid.state.angular_velocity / speed);
    pose.orientation = (turn * pose.orientation).normalized();
  }
  pose.position = center - pose.orientation * solid.frame->center;
  return pose;
}

}  // namespace

std::optional<double> first_touch(const FlyingBall& ball, const FlyingSolid& solid,
                                  double seconds) {
  const Vec3 relative_velocity = ball.velocity - solid.state.velocity;
  const double closing =
      relative_velocity.norm() + solid.state.angular_velocity.norm() * solid.reach;
  if (!(closing > 0)) return std::nullopt;

  const Vec3 start = ball.center - solid.state.pose.to_world(solid.frame->center);
  double time = 0;
  for (int advance = 0; advance < kMaxAdvances; ++advance) {
    // Far away the distance of the bounding spheres is bound enough, and cheap.
    double gap = (start + time * relative_velocity).norm() - solid.reach - ball.radius;
    const double left = (seconds - time) * closing;
    if (gap > left) return std::nullopt;
    if (gap < 0.1 * solid.reach) {
      const Vec3 center = pose_after(solid, time).to_local(ball.center + time * ball.velocity);
      gap = solid.surface->nearest(center).distance - ball.radius;
      if (gap > left) return std::nullopt;
    }
    if (gap <= kTouch) {
      if (advance == 0) return std::nullopt;
      return time;
    }
    time += gap / closing;
    if (time >= seconds) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<double> first_touch(const FlyingBall& a, const FlyingBall& b, double seconds) {
  const Vec3 apart = a.center - b.center;
  const Vec3 velocity = a.velocity - b.velocity;
  const double reach = a.radius + b.radius;
  if (apart.norm() - reach <= kTouch) return std::nullopt;
  const double approach = -apart.dot(velocity);
  const double speed2 = velocity.squaredNorm();
  const double inside = approach * approach - speed2 * (apart.squaredNorm() - reach * reach);
  if (approach <= 0 || inside < 0) return std::nullopt;
  const double time = (approach - std::sqrt(inside)) / speed2;
  if (time >= seconds) return std::nullopt;
  return time;
}

}  // namespace fracbench
