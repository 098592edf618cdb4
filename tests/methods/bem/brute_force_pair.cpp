#include "tests/methods/bem/brute_force_pair.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/bem/triangle_rules.h"

namespace fracbench::bem {
namespace {

struct Part {
  Corners corners;
  std::array<Vec3, 3> hats;  // of the whole triangle, at the corners
};

std::array<Part, 4> quarters(const Part& part) {
  std::array<Part, 4> result;
  const auto middle = [](const Vec3& a, const Vec3& b) -> Vec3 { return (a + b) / 2; };
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      result[k].corners[j] = middle(part.corners[k], part.corners[j]);
      result[k].hats[j] = middle(part.hats[k], part.hats[j]);
    }
    result[3].corners[k] = middle(part.corners[(k + 1) % 3], part.corners[(k + 2) % 3]);
    result[3].hats[k] = middle(part.hats[(k + 1) % 3], part.hats[(k + 2) % 3]);
  }
  return result;
}

double radius(const Corners& corners, const Vec3& centroid) {
  double largest = 0;
  for (const Vec3& corner : corners) largest = std::max(largest, (corner - centroid).norm());
  return largest;
}

Vec3 mean(const Corners& corners) { return (corners[0] + corners[1] + corners[2]) / 3; }

double area(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2; }

// Rules with different points, so that they never meet.
void add_leaf(const Part& test, const Part& trial, PairIntegrals& sums) {
  const Vec3 normal =
      (trial.corners[1] - trial.corners[0]).cross(trial.corners[2] - trial.corners[0]).normalized();
  const double scale = area(test.corners) * area(trial.corners);
  const auto at = [](const std::array<Vec3, 3>& values, const TrianglePoint& p) -> Vec3 {
    return values[0] + p.u * (values[1] - values[0]) + p.v * (values[2] - values[0]);
  };
  for (const TrianglePoint& p : triangle_rule(12)) {
    for (const TrianglePoint& q : triangle_rule(6)) {
      const Vec3 r = at(test.corners, p) - at(trial.corners, q);
      const double factor = scale * p.weight * q.weight / (r.squaredNorm() * r.norm());
      const double terms[] = {r.x() * r.x(), r.y() * r.y(), r.z() * r.z(),
                              r.x() * r.y(), r.x() * r.z(), r.y() * r.z()};
      for (int k = 0; k < 6; ++k) sums.values[k] += factor * terms[k];
      const Vec3 hats = at(trial.hats, q);
      for (int k = 0; k < 3; ++k) sums.values[6 + k] += factor * normal.dot(r) * hats[k];
    }
  }
}

void add(const Part& test, const Part& trial, int levels, PairIntegrals& sums) {
  const Vec3 a = mean(test.corners);
  const Vec3 b = mean(trial.corners);
  const double apart = (a - b).norm() / (radius(test.corners, a) + radius(trial.corners, b));
  if (levels == 0 || apart > 3) return add_leaf(test, trial, sums);
  for (const Part& first : quarters(test)) {
    for (const Part& second : quarters(trial)) add(first, second, levels - 1, sums);
  }
}

}  // namespace

PairIntegrals brute_force_pair(const Corners& test, const Corners& trial) {
  constexpr int kCoarsest = 1;
  constexpr int kFinest = 4;
  const std::array<Vec3, 3> whole = {Vec3::Unit(0), Vec3::Unit(1), Vec3::Unit(2)};
  const bool touching = std::any_of(test.begin(), test.end(), [&](const Vec3& corner) {
    return std::find(trial.begin(), trial.end(), corner) != trial.end();
  });
  std::array<PairIntegrals, kFinest + 1> levels;
  for (int k = touching ? kCoarsest : kFinest; k <= kFinest; ++k) {
    add({test, whole}, {trial, whole}, k, levels[k]);
  }
  double ratio = 0.5;
  for (int first = kCoarsest + 1; touching && first <= kFinest; ++first, ratio /= 2) {
    for (int k = kFinest; k >= first; --k) {
      for (std::size_t c = 0; c < levels[k].values.size(); ++c) {
        levels[k].values[c] = (levels[k].values[c] - ratio * levels[k - 1].values[c]) / (1 - ratio);
      }
    }
  }
  return levels[kFinest];
}

double single_layer_error(const PairIntegrals& computed, const PairIntegrals& expected) {
  double largest = 0;
  for (int k = 0; k < 6; ++k) {
    largest = std::max(largest, std::abs(computed.values[k] - expected.values[k]));
  }
  return largest / expected.inverse_distance();
}

double double_layer_error(const PairIntegrals& computed, const PairIntegrals& expected,
                          double area_product) {
  double largest = 0;
  for (int k = 6; k < 9; ++k) {
    largest = std::max(largest, std::abs(computed.values[k] - expected.values[k]));
  }
  return largest * area_product / std::pow(expected.inverse_distance(), 2);
}

}  // namespace fracbench::bem
