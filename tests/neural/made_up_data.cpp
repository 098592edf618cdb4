#include "made_up_data.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/random.h"
#include "core/voxel_grid.h"

namespace fracbench::test {

namespace {

std::vector<float> field_of(const Vec3& normal, double offset, int r) {
  VoxelGrid<float> grid = unit_grid<float>(r);
  for (int k = 0; k < r; ++k) {
    for (int j = 0; j < r; ++j) {
      for (int i = 0; i < r; ++i) {
        const Vec3 p = grid.position(i, j, k);
        const double outside = 0.8 - p.norm(), along = normal.dot(p);
        const double cuts = std::min(std::abs(along - offset), std::abs(along + 0.25));
        grid.at(i, j, k) = static_cast<float>(outside < 0 ? outside : std::min(outside, cuts));
      }
    }
  }
  return grid.values;
}

}  // namespace

neural::DataSet made_up_data(int patterns, const std::vector<int>& resolutions, int features) {
  neural::DataSet data{
      .shapes = {{.name = "ball",
                  .digest = "0123",
                  .scaling = {.centre = {0, 0, 0}, .half_side = 0.8, .max_impulse = 1e6}}},
      .provenance = R"({"made":"up"})",
      .features = features,
      .patterns = {}};
  Random random(7);
  for (int n = 0; n < patterns; ++n) {
    neural::Pattern pattern{.name = "made-up-" + std::to_string(n), .impulses = {}, .fields = {}};
    const Vec3 normal = random.unit_vector();
    const double offset = random.uniform(0, 0.4);
    for (int f = 0; f < features; ++f) {
      for (int c = 0; c < 3; ++c) pattern.impulses.push_back(static_cast<float>(normal[c]));
      for (int c = 0; c < 3; ++c) pattern.impulses.push_back(static_cast<float>(-normal[c]));
      pattern.impulses.push_back(static_cast<float>(2 * offset));
    }
    for (const int r : resolutions) pattern.fields[r] = field_of(normal, offset, r);
    data.patterns.push_back(std::move(pattern));
  }
  return data;
}

}  // namespace fracbench::test
