#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/voxel_grid.h"
#include "methods/bem/body_stress.h"
#include "methods/bem/crack_growth.h"

namespace fracbench::bem {

/// What there is to see of a break.
struct PictureData {
  const TriangleMesh& elements;
  const BodyStress& stress;
  const Eigen::Matrix3Xd& tractions;  ///< Pa, 3 x triangles
  std::span<const Crack> cracks;
  const StressIntensityModel& stress_intensity;
  const VoxelGrid<std::int32_t>& labels;
};

/// Writes VTK files for ParaView into `folder`, which exists; `which` is Impact::fragment:
///   bem_WHICH_surface.vtp  the boundary elements: displacement (m), traction (Pa), principal
///                          stresses (Pa, largest first) and the direction of the largest
///   bem_WHICH_cracks.vtp   the surfaces of all cracks as the voxels are cut by them
///   bem_WHICH_sheets.vtp   the cracks' coarse triangles: K_I, K_II, K_III (Pa sqrt(m)) at the
///                          fronts, 0 elsewhere
///   bem_WHICH_labels.vti   the fragments' voxels
/// WHICH: `target`, or `piece_N`. Throws InputError where they cannot be written.
void write_pictures(const std::filesystem::path& folder, std::int32_t which,
                    const PictureData& data);

}  // namespace fracbench::bem
