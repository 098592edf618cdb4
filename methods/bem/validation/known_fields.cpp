#include "methods/bem/validation/known_fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "methods/bem/elastic_operator.h"

namespace fracbench::bem {

Vec3 KelvinSource::displacement(const Vec3& x, const Material& material) const {
  const double nu = material.poisson_ratio;
  const Vec3 r = x - point;
  const double length = r.norm();
  const Vec3 e = r / length;
  return ((3 - 4 * nu) * force + e.dot(force) * e) /
         (16 * std::numbers::pi * shear_modulus(material) * (1 - nu) * length);
}

Mat3 KelvinSource::stress(const Vec3& x, const Material& material) const {
  const double nu = material.poisson_ratio;
  const Vec3 r = x - point;
  const Vec3 e = r.normalized();
  const double along = e.dot(force);
  const Mat3 mixed = force * e.transpose();
  return -(3 * along * e * e.transpose() +
           (1 - 2 * nu) * (mixed + mixed.transpose() - along * Mat3::Identity())) /
         (8 * std::numbers::pi * (1 - nu) * r.squaredNorm());
}

double thick_sphere_hoop_stress(double a, double b, double p) {
  const double a3 = a * a * a;
  const double b3 = b * b * b;
  return p * (a3 + b3 / 2) / (b3 - a3);
}

double integrated_contact_duration(const HertzContact& contact) {
  const double stiffness = 4.0 / 3 * contact.modulus * std::sqrt(contact.radius) / contact.mass;
  const auto acceleration = [&](double depth) {
    return -stiffness * std::pow(std::max(depth, 0.0), 1.5);
  };
  // Runge and Kutta's steps of fourth order. Both bodies reach the largest depth v / (frequency),
  // so that this step is about a 3000th of the duration.
  const double step = 1e-3 / std::pow(stiffness * stiffness * contact.speed, 0.2);
  double depth = 0;
  double speed = contact.speed;
  double time = 0;
  while (true) {
    const double v1 = speed;
    const double a1 = acceleration(depth);
    const double v2 = speed + step / 2 * a1;
    const double a2 = acceleration(depth + step / 2 * v1);
    const double v3 = speed + step / 2 * a2;
    const double a3 = acceleration(depth + step / 2 * v2);
    const double v4 = speed + step * a3;
    const double a4 = acceleration(depth + step * v3);
    const double next = depth + step / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    if (next <= 0) return time + step * depth / (depth - next);
    depth = next;
    speed += step / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    time += step;
  }
}

}  // namespace fracbench::bem
