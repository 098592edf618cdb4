#include "methods/bem/fast_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "methods/bem/validation/crack_meshes.h"

namespace fracbench::bem {
namespace {

TEST(FastModel, TakesTheStressAtEachFrontVertexAndTheAreaOfItsCrack) {
  // Stress growing along x; one small and one large crack with one vertex stopped.
  std::vector<CrackSheet> cracks{disc_crack(0.1, 2), disc_crack(0.2, 3)};
  cracks[1].states[5] = FrontState::at_surface;
  const StressField field = [](std::span<const Vec3> points) {
    std::vector<Mat3> stresses;
    for (const Vec3& x : points) stresses.push_back((1 + x.x()) * Mat3::Identity());
    return stresses;
  };
  const auto k = fast_model(field, FastFactors::authors(), 6)(cracks);
  ASSERT_EQ(k.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) {
    const std::size_t sides = cracks[c].boundary.size();
    const double r = c == 0 ? 0.1 : 0.2;
    const double area = static_cast<double>(sides) / 2 * r * r *
                        std::sin(2 * std::numbers::pi / static_cast<double>(sides));
    ASSERT_EQ(k[c].size(), sides);
    for (std::size_t i = 0; i < sides; ++i) {
      const double x = cracks[c].mesh.vertices[cracks[c].boundary[i]].x();
      const bool stopped = c == 1 && i == 5;
      const double expected =
          stopped ? 0 : 1.1215 * (1 + x) * std::pow(std::numbers::pi * area, 0.25);
      EXPECT_NEAR(k[c][i].mode_1, expected, 1e-12);
    }
  }
}

TEST(FastModel, CountsCompressionBySixth) {
  const std::vector<CrackSheet> cracks{disc_crack(0.1, 2)};
  const auto pull = [](double pressure) -> StressField {
    return [pressure](std::span<const Vec3> points) {
      return std::vector<Mat3>(points.size(), -pressure * Mat3::Identity());
    };
  };
  const auto pressed = fast_model(pull(6), FastFactors::authors(), 6)(cracks);
  const auto pulled = fast_model(pull(-1), FastFactors::authors(), 6)(cracks);
  EXPECT_NEAR(pressed[0][0].mode_1, pulled[0][0].mode_1, 1e-12);
}

}  // namespace
}  // namespace fracbench::bem
