#include "geometry/segmentation/join_labels.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace fracbench {
namespace {

/// The label that most neighbours carry, of equal ones the lowest; 0 where none carries one.
std::int32_t common_label(const FloodGrid& grid, std::int32_t voxel) {
  std::array<std::int32_t, 6> labels;
  int count = 0;
  for (const std::int32_t step : grid.steps(voxel)) {
    const std::int32_t label = grid.label(voxel + step);
    if (label > 0) labels[count++] = label;
  }
  std::int32_t best = 0;
  std::ptrdiff_t best_share = 0;
  for (int i = 0; i < count; ++i) {
    const auto share = std::count(labels.begin(), labels.begin() + count, labels[i]);
    if (share > best_share || (share == best_share && labels[i] < best)) {
      best = labels[i];
      best_share = share;
    }
  }
  return best;
}

/// Shared voxel faces, by label and neighbour; only of labels below the minimum.
using Borders = std::vector<std::map<std::int32_t, std::int64_t>>;

Borders borders_of_small_labels(const FloodGrid& grid, const std::vector<std::int64_t>& voxels,
                                std::int64_t minimum) {
  Borders borders(voxels.size());
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::int32_t voxel = grid.index(i, j, k), label = grid.label(voxel);
        if (label <= 0) continue;
        const FloodGrid::Steps& steps = grid.steps(voxel);
        for (const std::int32_t step : {steps[3], steps[4], steps[5]}) {  // each pair once
          const std::int32_t other = grid.label(voxel + step);
          if (other <= 0 || other == label) continue;
          if (voxels[label] < minimum || voxels[other] < minimum) {
            ++borders[label][other];
            ++borders[other][label];
          }
        }
      }
    }
  }
  return borders;
}

}  // namespace

std::int64_t give_dams_to_labels(FloodGrid& grid) {
  std::vector<std::int32_t> waiting;
  for (std::size_t brick = 0; brick < grid.storage.size(); ++brick) {
    for (std::size_t i = 0; i < 8; ++i) {
      const std::int32_t label = grid.storage[brick].cells[i].label;
      if (label > 0 || label == flood::wall) continue;
      waiting.push_back(static_cast<std::int32_t>(8 * brick + i));
    }
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> given;  // voxel and label, for one round
  std::int64_t total = 0;
  do {
    given.clear();
    std::erase_if(waiting, [&](std::int32_t voxel) {
      const std::int32_t label = common_label(grid, voxel);
      if (label > 0) given.emplace_back(voxel, label);
      return label > 0;
    });
    for (const auto& [voxel, label] : given) grid.label(voxel) = label;
    total += static_cast<std::int64_t>(given.size());
  } while (!given.empty());
  return total;
}

JoinedLabels join_small_labels(const FloodGrid& grid, std::vector<std::int64_t> voxels,
                               std::int64_t minimum) {
  JoinedLabels result;
  result.target.resize(voxels.size());
  std::iota(result.target.begin(), result.target.end(), 0);
  std::set<std::pair<std::int64_t, std::int32_t>> small;
  for (std::size_t label = 1; label < voxels.size(); ++label) {
    if (voxels[label] < minimum) small.emplace(voxels[label], static_cast<std::int32_t>(label));
  }
  if (small.empty()) return result;

  Borders borders = borders_of_small_labels(grid, voxels, minimum);
  while (!small.empty()) {
    const std::int32_t label = small.begin()->second;
    small.erase(small.begin());
    if (borders[label].empty()) {
      ++result.islands;
      continue;
    }
    const std::int32_t to =
        std::max_element(borders[label].begin(), borders[label].end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; })
            ->first;
    ++result.joined;
    result.target[label] = to;
    const bool was_small = small.erase({voxels[to], to}) > 0;
    voxels[to] += voxels[label];
    if (was_small && voxels[to] < minimum) small.emplace(voxels[to], to);
    for (const auto& [other, faces] : borders[label]) {
      borders[other].erase(label);
      if (other == to) continue;
      borders[other][to] += faces;
      borders[to][other] += faces;
    }
    borders[label].clear();
  }
  // A label's receiver may itself have been given away, later.
  for (std::int32_t& target : result.target) {
    while (result.target[target] != target) target = result.target[target];
  }
  return result;
}

}  // namespace fracbench
