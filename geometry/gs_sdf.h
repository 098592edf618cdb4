#pragma once

#include "core/fragments.h"
#include "core/voxel_grid.h"
#include "geometry/fragment_labels.h"

namespace fracbench {

/// The geometrically segmented signed distance function of a broken body, equation (4) of the
/// DeepFracture paper: inside the body the distance to the nearest surface of any fragment,
/// positive; outside the distance to the body's own surface, negative; m.
///
/// `body_distance` is the signed distance to the unbroken body on the wanted grid
/// (signed_distance_grid): it serves all patterns of one body. Fragments must fill the body, as
/// they do unless a method loses material; faces that are tagged original are taken to lie on its
/// surface. Exact to the rounding of float at every sample; the same bytes for any number of
/// threads.
VoxelGrid<float> gs_sdf(const VoxelGrid<float>& body_distance, const Fragments& fragments,
                        int threads = 2);

/// Limits a field to +-`distance`, m, as truncated signed distance fields are.
void truncate(VoxelGrid<float>& field, double distance);

}  // namespace fracbench
