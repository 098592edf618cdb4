#include "methods/deepfracture/round_trip.h"

#include <fmt/format.h>

#include "core/adjusted_rand_index.h"
#include "geometry/fragment_labels.h"

namespace fracbench::deepfracture {

std::vector<double> round_trip(const LearningData& learning, const neural::DataSet& data,
                               int resolution, const SegmentationOptions& segmentation,
                               const Context& context) {
  SegmentationOptions options = segmentation;
  options.threads = context.threads;
  const std::string what = fmt::format("round trips at r = {}", resolution);
  std::vector<double> result;
  VoxelGrid<float> field = unit_grid<float>(resolution);
  for (const neural::Pattern& pattern : data.patterns) {
    context.stop_if_asked();
    context.progress.update(
        what, static_cast<double>(result.size()) / static_cast<double>(data.patterns.size()));
    field.values = pattern.fields.at(resolution);
    const VoxelGrid<std::int32_t> truth =
        fragment_labels(learning.examples[result.size()].fragments,
                        unit_grid<std::int32_t>(resolution), context.threads);
    result.push_back(
        adjusted_rand_index(truth.values, caged_sdf_segmentation(field, options).labels.values));
  }
  return result;
}

}  // namespace fracbench::deepfracture
