#pragma once

#include <string>
#include <vector>

#include "core/context.h"
#include "core/target.h"
#include "methods/deepfracture/settings.h"
#include "methods/method.h"
#include "neural/data_set.h"
#include "neural/model.h"

namespace fracbench::deepfracture {

/// SHA-256 of a target's mesh, as models and data sets name it.
std::string shape_digest(const TriangleMesh& mesh);

/// The fractures of a target as a network learns them, and those of further shapes, in the order of
/// the digests of their meshes: the same for each of the shapes. Where they come from is for the
/// caller to say, in `provenance`. Throws InputError where a shape has fewer than
/// settings.least_patterns. Reports progress, stops when asked.
neural::DataSet make_data_set(const Target& target, const LearningData& learning,
                              const Settings& settings, const Context& context);

/// Agreement of voxel labels with the fragments that they stand for, by adjusted Rand index, for
/// patterns of one shape.
struct Agreement {
  /// Exact fields through segmentation: what no prediction can beat.
  std::vector<double> round_trip;
  /// Fields that the model decodes from the row of the codebook that belongs to the pattern.
  std::vector<double> decoded;
};

/// Both, for at most `most` of the training patterns of each shape, at the resolution that is cut;
/// as many as the model has shapes, in their order. Patterns that have no row in the codebook are
/// left out.
std::vector<Agreement> measure_agreement(const Target& target, const LearningData& learning,
                                         const neural::DataSet& data, const neural::Model& model,
                                         const Settings& settings, const Context& context,
                                         std::size_t most);

}  // namespace fracbench::deepfracture
