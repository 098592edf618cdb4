#include "geometry/gs_sdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/parallel.h"
#include "geometry/signed_distance/distance_brick.h"

namespace fracbench {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

/// The corners of a face in an order that both sides of a crack share.
Corners sorted_corners(const TriangleMesh& mesh, std::size_t f) {
  Corners corners;
  for (int k = 0; k < 3; ++k) std::ranges::copy(mesh.corner(f, k), corners[k].begin());
  std::ranges::sort(corners);
  return corners;
}

/// All faces of cracks, those that two fragments share once.
TriangleMesh fracture_surface(const Fragments& fragments) {
  TriangleMesh surface;
  std::set<Corners> seen;
  for (const Fragment& fragment : fragments) {
    for (std::size_t f = 0; f < fragment.mesh.faces.size(); ++f) {
      if (!fragment.faces[f].is_fracture()) continue;
      if (!seen.insert(sorted_corners(fragment.mesh, f)).second) continue;
      const auto first = static_cast<std::int32_t>(surface.vertices.size());
      for (int k = 0; k < 3; ++k) surface.vertices.push_back(fragment.mesh.corner(f, k));
      surface.faces.push_back({first, first + 1, first + 2});
    }
  }
  return surface;
}

/// Brings the samples of two rows in two slices that are inside as near to the cracks as they are.
void approach(const TriangleTree& cracks, VoxelGrid<float>& field, int j, int k) {
  DistanceBrick brick;
  DistanceBrick::Guess guess;
  for (int i = 0; i < field.size[0]; i += 2) {
    brick.place(field, i, j, k);
    const auto inside = [&](std::size_t sample) { return field.values[sample] > 0; };
    if (std::ranges::none_of(brick.samples(), inside)) continue;
    const auto nearest = brick.nearest(cracks, guess);
    for (int lane = 0; lane < DistanceBrick::size; ++lane) {
      float& value = field.values[brick.samples()[lane]];
      if (value <= 0) continue;
      value = std::min(value, static_cast<float>(std::sqrt(nearest[lane].squared_distance)));
    }
  }
}

}  // namespace

VoxelGrid<float> gs_sdf(const VoxelGrid<float>& body_distance, const Fragments& fragments,
                        int threads) {
  VoxelGrid<float> field = body_distance;
  const TriangleMesh cracks = fracture_surface(fragments);
  if (cracks.empty()) return field;
  const TriangleTree tree(cracks);
  const int pairs = (field.size[2] + 1) / 2;
  parallel_for(pairs, threads, [&](std::size_t pair) {
    for (int j = 0; j < field.size[1]; j += 2) {
      approach(tree, field, j, 2 * static_cast<int>(pair));
    }
  });
  return field;
}

void truncate(VoxelGrid<float>& field, double distance) {
  const auto limit = static_cast<float>(distance);
  for (float& value : field.values) value = std::clamp(value, -limit, limit);
}

}  // namespace fracbench
