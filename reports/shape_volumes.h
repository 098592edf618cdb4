#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/cell_groups.h"

namespace fracbench {

/// The methods of one shape, restricted to the cells that broke, and the volume that they share.
struct ShapeVolumes {
  std::string shape;
  std::vector<CellGroup> methods;
  double cut = 0;  ///< the largest of their smallest volumes, V_body / 10
};

std::vector<ShapeVolumes> volumes_by_shape(const ReportInput& input);

/// The fragment volumes of one method, collision by collision, ready to be drawn again and again.
class CollisionVolumes {
 public:
  /// Of the cells of that method among these collisions; those above the cut, V_body / 10.
  CollisionVolumes(std::span<const std::vector<CellRef>> collisions, std::string_view label,
                   double cut);

  /// The volumes of these collisions together, ascending; of one that is named twice, twice.
  std::vector<double> of(std::span<const std::size_t> chosen) const;

 private:
  std::size_t collisions_;
  std::vector<std::pair<double, std::size_t>> volumes_;  ///< with the collision, ascending
};

/// The volumes of all fragments of these cells that are above the cut, V_body / 10.
std::vector<double> volumes_above(std::span<const CellRef> cells, double cut);

}  // namespace fracbench
