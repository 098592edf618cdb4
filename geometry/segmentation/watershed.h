#pragma once

#include "geometry/segmentation/extended_minima.h"
#include "geometry/segmentation/flood_grid.h"

namespace fracbench {

/// Floods the relief from its labelled minima, 6-connected, with dams (Meyer and Beucher,
/// "Morphological segmentation", 1990): voxels are taken by their height in the relief with the
/// minima imposed (Soille, chapter 6: minima at 0, height + 1 elsewhere, every other basin filled),
/// among equals in the order in which they were reached. A voxel beside one label takes it and
/// reaches its neighbours; one beside several becomes a dam and reaches nothing. Voxels behind dams
/// stay untouched or reached. Overwrites the heights of what it reaches by the imposed ones.
///
/// The imposed relief is not reconstructed beforehand: the flood meets every voxel first at its
/// imposed height, but for those behind dams, which a second flood in the same queue looks after.
void flood_watershed(FloodGrid& grid, const ExtendedMinima& minima);

}  // namespace fracbench
