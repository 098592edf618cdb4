#include "methods/deepfracture/patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <span>

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

/// What there is to learn of one shape.
struct ShapeToLearn {
  std::string name;
  std::string digest;
  const TriangleMesh& mesh;
  std::span<const LearningExample> examples;
  double max_impulse;
};

/// The target and the further shapes, in the order of their digests.
std::vector<ShapeToLearn> shapes_to_learn(const Target& target, const LearningData& learning) {
  std::vector<ShapeToLearn> shapes{{.name = target.name,
                                    .digest = shape_digest(target.mesh),
                                    .mesh = target.mesh,
                                    .examples = learning.examples,
                                    .max_impulse = learning.max_impulse}};
  for (const FurtherLearning& further : learning.further) {
    shapes.push_back({.name = further.shape,
                      .digest = shape_digest(further.mesh),
                      .mesh = further.mesh,
                      .examples = further.examples,
                      .max_impulse = further.max_impulse});
  }
  // By place: what refers to a mesh cannot be assigned.
  std::vector<std::size_t> order(shapes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t s) { return std::string_view(shapes[s].digest); });
  std::vector<ShapeToLearn> sorted;
  for (const std::size_t s : order) sorted.push_back(shapes[s]);
  return sorted;
}

neural::DataSet data_of(const ShapeToLearn& shape, const Settings& settings,
                        const Context& context) {
  if (shape.examples.size() < static_cast<std::size_t>(settings.least_patterns)) {
    throw InputError(fmt::format(
        "deepfracture: there are {} fractures of '{}' to learn from, at least {} are wanted; the "
        "suite needs a table [learning] with more collisions that break it (docs/learning-data.md)",
        shape.examples.size(), shape.name, settings.least_patterns));
  }
  neural::DataSet data{.shapes = {{.name = shape.name,
                                   .digest = shape.digest,
                                   .scaling = impulse_scaling(shape.mesh, shape.max_impulse)}},
                       .provenance = {},
                       .features = settings.network.features,
                       .field_unit = settings.truncation > 0 ? settings.truncation : 1,
                       .patterns = {}};
  std::map<int, VoxelGrid<float>> body;
  for (const int r : settings.network.resolutions) {
    body[r] = signed_distance_grid(shape.mesh, unit_grid<float>(r), context.threads);
  }
  const auto count = static_cast<double>(shape.examples.size());
  for (const LearningExample& example : shape.examples) {
    context.stop_if_asked();
    context.progress.update("distance fields", static_cast<double>(data.patterns.size()) / count);
    neural::Pattern pattern{.name = fmt::format("pattern {}", data.patterns.size() + 1),
                            .impulses = impulse_vector(example.impact, data.shapes.front().scaling,
                                                       settings.network.features),
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

}  // namespace

std::string shape_digest(const TriangleMesh& mesh) {
  Digest digest;
  digest.add(mesh);
  return digest.hex();
}

neural::DataSet make_data_set(const Target& target, const LearningData& learning,
                              const Settings& settings, const Context& context) {
  std::vector<neural::DataSet> sets;
  for (const ShapeToLearn& shape : shapes_to_learn(target, learning)) {
    sets.push_back(data_of(shape, settings, context));
  }
  return neural::joined(std::move(sets));
}

std::vector<Agreement> measure_agreement(const Target& target, const LearningData& learning,
                                         const neural::DataSet& data, const neural::Model& model,
                                         const Settings& settings, const Context& context,
                                         std::size_t most) {
  const std::vector<ShapeToLearn> shapes = shapes_to_learn(target, learning);
  // The patterns of each shape lie together.
  std::vector<std::size_t> first(shapes.size(), 0);
  for (std::size_t s = 1; s < shapes.size(); ++s) {
    first[s] = first[s - 1] + shapes[s - 1].examples.size();
  }
  std::vector<Agreement> result(shapes.size());
  const auto decoder = neural::make_decoder(model);
  SegmentationOptions segmentation = settings.reconstruct.segmentation;
  segmentation.threads = context.threads;
  for (std::size_t row = 0; row < model.rows(); ++row) {
    const auto pattern = static_cast<std::size_t>(model.codebook_pattern[row]);
    const auto shape = static_cast<std::size_t>(model.codebook_shape[row]);
    Agreement& judged = result[shape];
    if (judged.round_trip.size() == most) continue;
    context.stop_if_asked();
    context.progress.update("judging the training patterns",
                            static_cast<double>(row) / static_cast<double>(model.rows()));
    const VoxelGrid<std::int32_t> truth =
        fragment_labels(shapes[shape].examples[pattern - first[shape]].fragments,
                        unit_grid<std::int32_t>(settings.resolution), context.threads);
    const auto judge = [&](const VoxelGrid<float>& field) {
      return agreement(truth, caged_sdf_segmentation(field, segmentation).labels);
    };
    VoxelGrid<float> exact = unit_grid<float>(settings.resolution);
    exact.values = data.patterns[pattern].fields.at(settings.resolution);
    judged.round_trip.push_back(judge(exact));
    try {
      judged.decoded.push_back(
          judge(decoder->decode({model.row(row), data.patterns[pattern].impulses},
                                settings.resolution, context.threads)));
    } catch (const InputError&) {
      judged.decoded.push_back(0);  // no voxel inside: not a body at all
    }
  }
  return result;
}

}  // namespace fracbench::deepfracture
