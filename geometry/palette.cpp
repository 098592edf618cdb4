#include "geometry/palette.h"

#include <array>
#include <cmath>

namespace fracbench {

Vec3 fragment_color(std::size_t index) {
  // In an order in which neighbours in number differ most.
  static const std::array<Vec3, 7> hues = {
      Vec3(0, 114, 178),  Vec3(230, 159, 0),   Vec3(0, 158, 115), Vec3(213, 94, 0),
      Vec3(86, 180, 233), Vec3(204, 121, 167), Vec3(240, 228, 66)};
  static const Vec3 white = Vec3::Constant(1), black = Vec3::Zero();
  const Vec3 hue = hues[index % hues.size()] / 255;
  switch (index / hues.size() % 4) {
    case 1:
      return 0.55 * hue + 0.45 * white;
    case 2:
      return 0.65 * hue + 0.35 * black;
    case 3:
      return 0.78 * hue + 0.22 * white;
    default:
      return hue;
  }
}

Vec3 fracture_color() { return {0.90, 0.87, 0.82}; }

Vec3 linear_color(const Vec3& srgb) {
  return srgb.unaryExpr(
      [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); });
}

}  // namespace fracbench
