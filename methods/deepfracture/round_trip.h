#pragma once

#include <vector>

#include "core/context.h"
#include "geometry/caged_sdf_segmentation.h"
#include "methods/method.h"
#include "neural/data_set.h"

namespace fracbench::deepfracture {

/// What reconstruction alone keeps of fracture patterns, the ceiling of every prediction: for each
/// pattern of `data`, made from the examples of `learning` in their order, the adjusted Rand index
/// of its fragments and of the labels that segmentation finds in its field at that resolution, over
/// the samples inside the body. Reports progress, stops when asked.
std::vector<double> round_trip(const LearningData& learning, const neural::DataSet& data,
                               int resolution, const SegmentationOptions& segmentation,
                               const Context& context);

}  // namespace fracbench::deepfracture
