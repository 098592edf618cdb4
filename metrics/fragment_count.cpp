#include "metrics/fragment_count.h"

#include <algorithm>

#include "geometry/measures.h"
#include "metrics/measurement.h"

namespace fracbench {
namespace {

constexpr double kVoxels = 50;             // of the paper's published program, for r up to 128
constexpr double kVoxelSide = 2.0 / 128;   // r = 128 on [-1, 1]
constexpr double kNormalizedLength = 1.9;  // longest side of a body in that cube

}  // namespace

double smallest_counted_volume(const TriangleMesh& body) {
  const double side = kVoxelSide * bounding_box(body).longest_side() / kNormalizedLength;
  return kVoxels * side * side * side;
}

MetricInfo FragmentCount::info() const {
  return {.name = "fragment_count",
          .summary = "number of fragments, all and those above the paper's smallest volume"};
}

Measurement FragmentCount::measure(const CellResult& cell) const {
  Measurement result;
  const double minimum = smallest_counted_volume(cell.body);
  const auto fragments = measurable(cell.fragments);
  const auto above = std::ranges::count_if(
      fragments, [&](const Fragment& fragment) { return volume(fragment.mesh) >= minimum; });
  add_value(result, "fragment_count", static_cast<double>(cell.fragments.size()));
  add_value(result, "fragment_count_above_minimum", static_cast<double>(above));
  add_value(result, "minimum_volume_fraction", minimum / volume(cell.body));
  return result;
}

}  // namespace fracbench
