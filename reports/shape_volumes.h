#pragma once

#include <span>
#include <string>
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

/// The volumes of all fragments of these cells that are above the cut, V_body / 10.
std::vector<double> volumes_above(std::span<const CellRef> cells, double cut);

}  // namespace fracbench
