#pragma once

#include <cstdint>
#include <optional>

#include "core/voxel_grid.h"

namespace fracbench {

struct SegmentationOptions {
  /// Added to the field, so that the mask is a little larger than the body, m. By default the
  /// larger of 0.03 and half a voxel; under parity 0.03.
  std::optional<double> cage = {};
  /// How deep a basin must be to become a label of its own, in the relief's unit: 255 stand for a
  /// distance of 2 m, so 3 are 0.0235 m.
  double h = 3;
  /// Labels with fewer flooded voxels are dropped. By default 50, above r = 128 500.
  std::optional<std::int64_t> minimum_voxels = {};
  /// As the published method works: the whole grid is flooded and the mask applied afterwards;
  /// dams and dropped labels belong to no fragment.
  bool parity = false;
  int threads = 2;
};

struct Segmentation {
  /// 1 ... count inside the mask, -1 outside. Under parity 0 inside the mask where no label is.
  VoxelGrid<std::int32_t> labels;
  std::int32_t count = 0;
  double cage = 0;                  ///< that was used, m
  std::int64_t minimum_voxels = 0;  ///< that was used
  std::int64_t mask_voxels = 0;
  /// Voxels of the mask that flooding left without a label: dams, and what lies behind them.
  std::int64_t dam_voxels = 0;
  std::int32_t flooded_labels = 0;  ///< with voxels inside the mask
  std::int32_t dropped_labels =
      0;  ///< of these, given to a neighbour (parity: lost) for their size
  /// Labels below minimum_voxels that fill a part of the mask of their own, and are kept.
  std::int32_t islands = 0;
};

/// Divides the body that a GS-SDF describes into its fragments: section 5.2 of the DeepFracture
/// paper. `field` is positive inside the fragments (distance to the nearest surface of any of them)
/// and negative outside. Mask: g = field + cage >= 0; relief: 255 - (|g| + 1) / 2 * 255 in single
/// precision; its extended minima (dynamic h, 6-connected) are the labels, and flooding from them
/// the watershed. See docs/segmentation.md for the rules and for what differs under parity.
///
/// By default nothing outside the mask is flooded, and every voxel of the mask has a label at the
/// end. Labels are numbered in the order in which their minima are met by z, then y, then x; the
/// result does not depend on the number of threads.
///
/// Throws InputError where the field has no voxels, values that do not match its size, a spacing
/// that is not positive, a voxel that is NaN or infinite or no voxel inside the mask, where an
/// option is out of range, and, before memory is taken, where that does not suffice.
Segmentation caged_sdf_segmentation(const VoxelGrid<float>& field,
                                    const SegmentationOptions& options = {});

}  // namespace fracbench
