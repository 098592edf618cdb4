#include "methods/bem/growth_law.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace fracbench::bem {

double effective_stress_intensity(const StressIntensity& k, double poisson_ratio,
                                  double compressive_factor) {
  const double mode_1 = k.mode_1 >= 0 ? k.mode_1 : -k.mode_1 / compressive_factor;
  return std::hypot(mode_1, k.mode_2, k.mode_3 / std::sqrt(1 - poisson_ratio));
}

Mat3 driving_stress(const Mat3& stress, double compressive_factor) {
  const Vec3 principal =
      Eigen::SelfAdjointEigenSolver<Mat3>(stress, Eigen::EigenvaluesOnly).eigenvalues();
  const bool compressed = -principal[0] / compressive_factor > principal[2];
  return compressed ? Mat3(stress / -compressive_factor) : stress;
}

double rayleigh_speed(const Material& material) {
  const double nu = material.poisson_ratio;
  const double shear_speed = std::sqrt(material.young_modulus / (2 * (1 + nu)) / material.density);
  const double ratio2 = (1 - 2 * nu) / (2 - 2 * nu);  // (c_s / c_p)^2
  const auto excess = [&](double x) {                 // x = (c / c_s)^2; 0 at x = 0 as well
    return (2 - x) * (2 - x) - 4 * std::sqrt((1 - x * ratio2) * (1 - x));
  };
  // The root lies between 0.47 (nu -> -1) and 0.92 (nu = 1/2); there the function only grows.
  double low = 0.2;
  double high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (excess(middle) < 0 ? low : high) = middle;
  }
  return shear_speed * std::sqrt((low + high) / 2);
}

double crack_speed(double effective_stress_intensity, const Material& material) {
  if (!(effective_stress_intensity > material.toughness)) return 0;
  const double ratio = material.toughness / effective_stress_intensity;
  return rayleigh_speed(material) * std::max(0.1, 1 - ratio * ratio);
}

double kink_angle(const StressIntensity& k, double poisson_ratio) {
  const double opening =
      std::hypot(std::max(k.mode_1, 0.0), k.mode_3 / std::sqrt(1 - poisson_ratio));
  const double root = std::hypot(opening, std::sqrt(8.0) * k.mode_2);
  // (K - root) / (4 K_II) without the difference of nearly equal numbers.
  return root > 0 ? 2 * std::atan(-2 * k.mode_2 / (opening + root)) : 0;
}

Vec3 kink_direction(const FrontFrame& frame, double angle) {
  return std::cos(angle) * frame.forward + std::sin(angle) * frame.normal;
}

}  // namespace fracbench::bem
