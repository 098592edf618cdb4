#include "methods/bem/stress_intensity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "methods/bem/front_frames.h"
#include "methods/bem/front_profile.h"

namespace fracbench::bem {
namespace {

using std::numbers::pi;

double shear_modulus(const Material& material) {
  return material.young_modulus / (2 * (1 + material.poisson_ratio));
}

/// Distances behind the front, in local edge lengths, at which the opening is read. Nearer, linear
/// elements show which vertex is where (up to 9 % too much at the first one); farther, the opening
/// is no longer that of the front alone.
constexpr std::array<double, 2> kReadings = {2, 3};

/// The correlation after division by the elliptic profile; where there is a mouth, without what of
/// the quotient grows with the square of the distance.
StressIntensity from_profile(const FrontProfile& profile, const FrontFrame& frame,
                             const Material& material) {
  const double reach = profile.distances.back();
  double widest = 0;
  for (const Vec3& opening : profile.openings) widest = std::max(widest, opening.norm());
  const bool closed = profile.openings.back().norm() <= 0.1 * widest;
  const double chord = closed ? reach : 2 * reach;
  // w = A sqrt(r (1 - r / chord)) for a crack with an elliptic opening. The quotient is smooth,
  // which the opening is not: it is what may be interpolated between the sheet's vertices.
  std::vector<double> distances;
  std::vector<Vec3> quotients;
  for (std::size_t k = 1; k < profile.distances.size(); ++k) {
    const double r = profile.distances[k];
    if (closed && r >= reach) break;
    distances.push_back(r);
    quotients.emplace_back(profile.openings[k] / std::sqrt(r * (1 - r / chord)));
  }
  if (distances.empty()) return {};
  const auto at = [&](double r) -> Vec3 {
    const auto after = std::ranges::upper_bound(distances, r);
    if (after == distances.end()) return quotients.back();
    const auto k = static_cast<std::size_t>(after - distances.begin());
    if (k == 0) return quotients.front();
    const double part = (r - distances[k - 1]) / (distances[k] - distances[k - 1]);
    return (1 - part) * quotients[k - 1] + part * quotients[k];
  };
  const double middle = chord / 2;
  Vec3 sum = Vec3::Zero();
  for (const double reading : kReadings) {
    if (closed) {
      sum += at(std::min(reading * profile.edge_length, middle));
    } else {
      const double r = std::min(reading * profile.edge_length, 0.6 * middle);
      sum += at(r) - (at(middle) - at(r)) * r * r / (middle * middle - r * r);
    }
  }
  return displacement_correlation(sum / kReadings.size(), 1, frame, material);
}

}  // namespace

StressIntensity displacement_correlation(const Vec3& opening, double distance,
                                         const FrontFrame& frame, const Material& material) {
  const double antiplane = shear_modulus(material) / 4 * std::sqrt(2 * pi / distance);
  const double plane = antiplane / (1 - material.poisson_ratio);
  return {.mode_1 = plane * opening.dot(frame.normal),
          .mode_2 = plane * opening.dot(frame.forward),
          .mode_3 = antiplane * opening.dot(frame.tangent)};
}

Vec3 opening_from_stress_intensity(const StressIntensity& k, double distance,
                                   const FrontFrame& frame, const Material& material) {
  const double antiplane = 4 / shear_modulus(material) * std::sqrt(distance / (2 * pi));
  const double plane = antiplane * (1 - material.poisson_ratio);
  return plane * (k.mode_1 * frame.normal + k.mode_2 * frame.forward) +
         antiplane * k.mode_3 * frame.tangent;
}

std::vector<StressIntensity> stress_intensity_from_opening(const CrackSheet& sheet,
                                                           std::span<const Vec3> opening,
                                                           const Material& material) {
  const std::vector<FrontFrame> frames = front_frames(sheet);
  const FrontProfiles profiles(sheet);
  std::vector<StressIntensity> result(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (sheet.states[i] != FrontState::advancing) continue;
    const FrontProfile profile = profiles.behind(i, frames[i], opening);
    result[i] = from_profile(profile, frames[i], material);
  }
  return result;
}

std::vector<Vec3> opening_from_front(const CrackSheet& sheet, std::span<const StressIntensity> k,
                                     const Material& material) {
  const std::vector<FrontFrame> frames = front_frames(sheet);
  std::vector<Vec3> opening(sheet.mesh.vertices.size(), Vec3::Zero());
  for (std::size_t v = 0; v < opening.size(); ++v) {
    double nearest = HUGE_VAL;
    std::size_t source = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (sheet.states[i] != FrontState::advancing) continue;
      const double distance =
          (sheet.mesh.vertices[v] - sheet.mesh.vertices[sheet.boundary[i]]).norm();
      if (distance < nearest) {
        nearest = distance;
        source = i;
      }
    }
    if (nearest < HUGE_VAL) {
      opening[v] = opening_from_stress_intensity(k[source], nearest, frames[source], material);
    }
  }
  return opening;
}

FastFactors FastFactors::calibrated(double poisson_ratio) {
  const double shear = 4 / (pi * (2 - poisson_ratio));
  return {.mode_1 = 2 / pi, .mode_2 = shear, .mode_3 = shear * (1 - poisson_ratio)};
}

StressIntensity fast_stress_intensity(const Mat3& stress, double crack_area,
                                      const FrontFrame& frame, const FastFactors& factors) {
  const Vec3 traction = stress * frame.normal;
  const double length = std::sqrt(std::sqrt(pi * crack_area));
  return {.mode_1 = factors.mode_1 * length * traction.dot(frame.normal),
          .mode_2 = factors.mode_2 * length * traction.dot(frame.forward),
          .mode_3 = factors.mode_3 * length * traction.dot(frame.tangent)};
}

}  // namespace fracbench::bem
