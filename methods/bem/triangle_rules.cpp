#include "methods/bem/triangle_rules.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace fracbench::bem {
namespace {

// Three points (a, a), (1 - 2 a, a), (a, 1 - 2 a).
void add_three(std::vector<TrianglePoint>& rule, double a, double weight) {
  rule.push_back({a, a, weight});
  rule.push_back({1 - 2 * a, a, weight});
  rule.push_back({a, 1 - 2 * a, weight});
}

void add_six(std::vector<TrianglePoint>& rule, double a, double b, double weight) {
  const double c = 1 - a - b;
  for (const auto& [u, v] : {std::array{a, b}, std::array{b, a}, std::array{a, c}, std::array{c, a},
                             std::array{b, c}, std::array{c, b}}) {
    rule.push_back({u, v, weight});
  }
}

std::vector<TrianglePoint> make_rule(int points) {
  std::vector<TrianglePoint> rule;
  if (points == 3) {
    add_three(rule, 1.0 / 6, 1.0 / 3);
  } else if (points == 6) {
    add_three(rule, 0.445948490915965, 0.223381589678011);
    add_three(rule, 0.091576213509771, 0.109951743655322);
  } else {
    add_three(rule, 0.249286745170910, 0.116786275726379);
    add_three(rule, 0.063089014491502, 0.050844906370207);
    add_six(rule, 0.053145049844817, 0.310352451033784, 0.082851075618374);
  }
  return rule;
}

}  // namespace

std::span<const TrianglePoint> triangle_rule(int points) {
  static const std::vector<TrianglePoint> three = make_rule(3);
  static const std::vector<TrianglePoint> six = make_rule(6);
  static const std::vector<TrianglePoint> twelve = make_rule(12);
  switch (points) {
    case 3:
      return three;
    case 6:
      return six;
    case 12:
      return twelve;
    default:
      throw std::invalid_argument("no triangle rule with " + std::to_string(points) + " points");
  }
}

std::vector<LinePoint> gauss_legendre(int points) {
  std::vector<LinePoint> rule(points);
  for (int i = 0; i < points; ++i) {
    // Newton's iteration for the roots of the Legendre polynomial on [-1, 1].
    double x = std::cos(std::numbers::pi * (i + 0.75) / (points + 0.5));
    double slope = 1;
    for (int step = 0; step < 100; ++step) {
      double before = 1;
      double value = x;
      for (int k = 2; k <= points; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = points * (x * value - before) / (x * x - 1);
      const double change = value / slope;
      x -= change;
      if (std::abs(change) < 1e-16) break;
    }
    rule[points - 1 - i] = {(1 + x) / 2, 1 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}

}  // namespace fracbench::bem
