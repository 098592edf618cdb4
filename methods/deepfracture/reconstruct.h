#pragma once

#include <vector>

#include "core/breakable.h"
#include "core/context.h"
#include "core/voxel_grid.h"
#include "geometry/caged_sdf_segmentation.h"

namespace fracbench::deepfracture {

struct ReconstructOptions {
  /// Under parity, what segmentation gives to no label is lost, and so are components of few faces.
  SegmentationOptions segmentation = {};
  int minimum_faces = 0;  ///< of a component, under parity; 0: by the resolution
  /// Noise falls into thousands of interlocked fragments, on which rigid bodies and metrics would
  /// spend hours.
  int most_fragments = 1000;
  /// Fracture surfaces as fine as the body's own surface where the grid is finer (section 6.3),
  /// and not as fine as the grid.
  bool as_coarse_as_surface = false;
};

/// How few faces a component must have to be kept in the authors' program, by its resolution.
int minimum_faces(int resolution);

/// The pieces that a GS-SDF divides the closed mesh into: sections 5.2 and 5.3 of the DeepFracture
/// paper. They fill the body exactly, but under parity. Stages "segmentation" and "boolean"; notes
/// say what was lost or given away. Throws MethodFailure for a field that describes no fragment, or
/// too many.
std::vector<Piece> reconstruct(const TriangleMesh& body, const VoxelGrid<float>& field,
                               const ReconstructOptions& options, Context& context);

}  // namespace fracbench::deepfracture
