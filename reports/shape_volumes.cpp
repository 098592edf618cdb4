#include "reports/shape_volumes.h"

#include <algorithm>

#include "metrics/distribution_distance.h"
#include "metrics/fragment_volumes.h"

namespace fracbench {

std::vector<ShapeVolumes> volumes_by_shape(const ReportInput& input) {
  std::vector<ShapeVolumes> result;
  for (CellGroup& group : group_cells(input.cells)) {
    group.cells = broken_cells(group.cells);
    std::erase_if(group.cells, [](const CellSummary& cell) {
      return series_of(cell, "fragment_volume").empty();
    });
    if (group.cells.empty()) continue;
    if (result.empty() || result.back().shape != group.shape) result.push_back({group.shape, {}});
    ShapeVolumes& shape = result.back();
    for (const double minimum : values_of(group.cells, "minimum_volume_fraction")) {
      shape.cut = std::max(shape.cut, kParentVolume * minimum);
    }
    shape.methods.push_back(std::move(group));
  }
  return result;
}

std::vector<double> volumes_above(std::span<const CellRef> cells, double cut) {
  std::vector<double> volumes;
  for (const CellSummary& cell : cells) {
    const std::vector<double> above = truncated(series_of(cell, "fragment_volume"), cut);
    volumes.insert(volumes.end(), above.begin(), above.end());
  }
  return volumes;
}

CollisionVolumes::CollisionVolumes(std::span<const std::vector<CellRef>> collisions,
                                   std::string_view label, double cut)
    : collisions_(collisions.size()) {
  for (std::size_t c = 0; c < collisions.size(); ++c) {
    for (const CellSummary& cell : collisions[c]) {
      if (cell.label != label) continue;
      for (const double volume : series_of(cell, "fragment_volume")) {
        if (volume > cut) volumes_.emplace_back(volume, c);
      }
    }
  }
  std::ranges::sort(volumes_);
}

std::vector<double> CollisionVolumes::of(std::span<const std::size_t> chosen) const {
  std::vector<std::size_t> times(collisions_, 0);
  for (const std::size_t c : chosen) ++times[c];
  std::vector<double> volumes;
  for (const auto& [volume, collision] : volumes_) {
    volumes.insert(volumes.end(), times[collision], volume);
  }
  return volumes;
}

}  // namespace fracbench
