#include "test_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"

namespace fracbench::test {
namespace {

template <typename Value>
VoxelGrid<float> sampled(int r, const Value& value) {
  VoxelGrid<float> field = unit_grid<float>(r);
  for (int k = 0; k < r; ++k) {
    for (int j = 0; j < r; ++j) {
      for (int i = 0; i < r; ++i) {
        field.at(i, j, k) = static_cast<float>(value(field.position(i, j, k)));
      }
    }
  }
  return field;
}

/// Half the difference between the two smallest distances.
template <typename Distance>
double bisector_distance(const std::vector<Vec3>& sites, const Distance& distance) {
  double first = 100, second = 100;
  for (const Vec3& site : sites) {
    const double d = distance(site);
    second = std::min(second, std::max(first, d));
    first = std::min(first, d);
  }
  return (second - first) / 2;
}

}  // namespace

VoxelGrid<float> voronoi_ball(int r, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> sites;
  for (int i = 0; i < count; ++i) sites.push_back(0.8 * random.uniform() * random.unit_vector());
  return sampled(r, [&](const Vec3& x) {
    const double shell = 0.8 - x.norm();
    if (shell < 0) return shell;
    return std::min(shell, bisector_distance(sites, [&](const Vec3& s) { return (x - s).norm(); }));
  });
}

VoxelGrid<float> tied_ball(int r, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> sites;
  for (int i = 0; i < count; ++i) {
    Vec3 site;
    for (int axis = 0; axis < 3; ++axis) {
      site[axis] = 0.25 * (static_cast<double>(random.below(5)) - 2);
    }
    sites.push_back(site);
  }
  return sampled(r, [&](const Vec3& x) {
    const double shell = 0.8 - x.norm();
    const double value =
        shell < 0 ? shell : std::min(shell, bisector_distance(sites, [&](const Vec3& s) {
                                       return (x - s).lpNorm<1>();
                                     }));
    return std::round(value * 32) / 32;
  });
}

VoxelGrid<float> noise(std::array<std::int32_t, 3> size, float amplitude, float step,
                       std::uint64_t seed) {
  Random random(seed);
  VoxelGrid<float> field(size, Vec3::Constant(-1), 2.0 / size[0]);
  for (float& value : field.values) {
    value = static_cast<float>(random.uniform(-amplitude, amplitude));
    if (step > 0) value = std::round(value / step) * step;
  }
  return field;
}

VoxelGrid<float> two_balls(int r, float left_radius, float right_radius) {
  return sampled(r, [&](const Vec3& x) {
    return std::max(left_radius - (x - Vec3(-0.45, 0, 0)).norm(),
                    right_radius - (x - Vec3(0.45, 0, 0)).norm());
  });
}

std::vector<NamedField> all_fields() {
  std::vector<NamedField> fields;
  const auto add = [&](std::string name, VoxelGrid<float> field) {
    fields.push_back({std::move(name), std::move(field)});
  };
  add("Voronoi ball", voronoi_ball(24, 12, 1));
  add("Voronoi ball of many cells", voronoi_ball(20, 200, 2));
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    add(fmt::format("tied ball {}", seed), tied_ball(22, 9, seed));
    add(fmt::format("noise {}", seed), noise({15, 12, 14}, 1, 0, seed));
    add(fmt::format("small noise {}", seed), noise({12, 15, 13}, 0.03f, 0, seed));
    add(fmt::format("coarse noise {}", seed), noise({14, 13, 11}, 1, 0.05f, seed));
    add(fmt::format("fine-stepped noise {}", seed), noise({13, 12, 17}, 0.2f, 0.01f, seed));
    add(fmt::format("two-valued noise {}", seed), noise({12, 12, 12}, 0.05f, 0.05f, seed));
    add(fmt::format("noise of large values {}", seed), noise({11, 12, 13}, 500, 0, seed));
  }
  add("two balls", two_balls(26, 0.4f, 0.35f));
  add("constant inside", VoxelGrid<float>({6, 7, 5}, Vec3::Zero(), 0.1, 0.25f));
  add("constant outside", VoxelGrid<float>({6, 7, 5}, Vec3::Zero(), 0.1, -0.5f));
  add("one voxel", VoxelGrid<float>({1, 1, 1}, Vec3::Zero(), 1, 0.1f));
  add("rod in x", noise({60, 1, 1}, 1, 0, 5));
  add("rod in y", noise({1, 60, 1}, 1, 0.1f, 6));
  add("rod in z", noise({1, 1, 60}, 0.1f, 0, 7));
  add("slab", noise({1, 25, 31}, 1, 0.02f, 8));
  VoxelGrid<float> huge = noise({9, 8, 7}, 1, 0, 9);
  for (float& value : huge.values) value *= std::numeric_limits<float>::max();
  add("the largest floats", huge);
  return fields;
}

}  // namespace fracbench::test
