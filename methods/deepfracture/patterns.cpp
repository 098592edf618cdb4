#include "methods/deepfracture/patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/adjusted_rand_index.h"
#include "core/digest.h"
#include "core/error.h"
#include "core/impulse_vector.h"
#include "geometry/gs_sdf.h"
#include "geometry/signed_distance_grid.h"
#include "neural/field_decoder.h"

namespace fracbench::deepfracture {

namespace {

/// Agreement of two label volumes where `truth` has a label.
double agreement(const VoxelGrid<std::int32_t>& truth, const VoxelGrid<std::int32_t>& labels) {
  std::vector<std::int32_t> a, b;
  for (std::size_t n = 0; n < truth.values.size(); ++n) {
    if (truth.values[n] <= 0) continue;
    a.push_back(truth.values[n]);
    b.push_back(labels.values[n]);
  }
  return adjusted_rand_index(a, b);
}

}  // namespace

std::string shape_digest(const TriangleMesh& mesh) {
  Digest digest;
  digest.add(mesh);
  return digest.hex();
}

neural::DataSet make_data_set(const Target& target, const LearningData& learning,
                              const Settings& settings, const Context& context) {
  if (learning.examples.size() < static_cast<std::size_t>(settings.least_patterns)) {
    throw InputError(fmt::format(
        "deepfracture: there are {} fractures of '{}' to learn from, at least {} are wanted; the "
        "suite needs a table [learning] with more collisions that break it (docs/learning-data.md)",
        learning.examples.size(), target.name, settings.least_patterns));
  }
  neural::DataSet data{.shape = target.name,
                       .shape_digest = shape_digest(target.mesh),
                       .provenance = {},
                       .features = settings.network.features,
                       .scaling = impulse_scaling(target.mesh, learning.max_impulse),
                       .field_unit = settings.truncation > 0 ? settings.truncation : 1,
                       .patterns = {}};
  std::map<int, VoxelGrid<float>> body;
  for (const int r : settings.network.resolutions) {
    body[r] = signed_distance_grid(target.mesh, unit_grid<float>(r), context.threads);
  }
  const auto count = static_cast<double>(learning.examples.size());
  for (const LearningExample& example : learning.examples) {
    context.stop_if_asked();
    context.progress.update("distance fields", static_cast<double>(data.patterns.size()) / count);
    neural::Pattern pattern{
        .name = fmt::format("pattern {}", data.patterns.size() + 1),
        .impulses = impulse_vector(example.impact, data.scaling, settings.network.features),
        .fields = {}};
    for (const auto& [r, distance] : body) {
      VoxelGrid<float> field = gs_sdf(distance, example.fragments, context.threads);
      if (settings.truncation > 0) truncate(field, settings.truncation);
      pattern.fields[r] = std::move(field.values);
    }
    data.patterns.push_back(std::move(pattern));
  }
  return data;
}

Agreement measure_agreement(const LearningData& learning, const neural::DataSet& data,
                            const neural::Model& model, const Settings& settings,
                            const Context& context, std::size_t most) {
  Agreement result;
  const auto decoder = neural::make_decoder(model);
  const std::size_t count = std::min(most, model.rows());
  SegmentationOptions segmentation = settings.reconstruct.segmentation;
  segmentation.threads = context.threads;
  for (std::size_t row = 0; row < count; ++row) {
    context.stop_if_asked();
    context.progress.update("judging the training patterns",
                            static_cast<double>(row) / static_cast<double>(count));
    const auto pattern = static_cast<std::size_t>(model.codebook_pattern[row]);
    const VoxelGrid<std::int32_t> truth =
        fragment_labels(learning.examples[pattern].fragments,
                        unit_grid<std::int32_t>(settings.resolution), context.threads);
    const auto judge = [&](const VoxelGrid<float>& field) {
      return agreement(truth, caged_sdf_segmentation(field, segmentation).labels);
    };
    VoxelGrid<float> exact = unit_grid<float>(settings.resolution);
    exact.values = data.patterns[pattern].fields.at(settings.resolution);
    result.round_trip.push_back(judge(exact));
    try {
      result.decoded.push_back(
          judge(decoder->decode({model.row(row), data.patterns[pattern].impulses},
                                settings.resolution, context.threads)));
    } catch (const InputError&) {
      result.decoded.push_back(0);  // no voxel inside: not a body at all
    }
  }
  return result;
}

}  // namespace fracbench::deepfracture
