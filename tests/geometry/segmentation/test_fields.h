#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/voxel_grid.h"

// Fields in the form of a GS-SDF, made of formulas and seeds.
namespace fracbench::test {

struct NamedField {
  std::string name;
  VoxelGrid<float> field;
};

/// A ball of radius 0.8 cut by the Voronoi diagram of `sites` random sites.
VoxelGrid<float> voronoi_ball(int r, int sites, std::uint64_t seed);

/// The same with Manhattan distances of lattice sites, rounded to multiples of 1/32: mostly ties.
VoxelGrid<float> tied_ball(int r, int sites, std::uint64_t seed);

/// Uniform in [-amplitude, amplitude] everywhere, rounded to multiples of `step` where that is
/// positive.
VoxelGrid<float> noise(std::array<std::int32_t, 3> size, float amplitude, float step,
                       std::uint64_t seed);

/// Two balls of the given radii around (-0.45, 0, 0) and (0.45, 0, 0), each a fragment.
VoxelGrid<float> two_balls(int r, float left_radius, float right_radius);

/// One of each kind, and the extremes: constant fields, single voxels, rods and slabs, all values
/// far outside [-1, 1].
std::vector<NamedField> all_fields();

}  // namespace fracbench::test
