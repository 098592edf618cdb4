#pragma once

#include <cstdint>
#include <filesystem>

#include "core/voxel_grid.h"

namespace fracbench {

/// Reads a volume of integer labels with its place in space, from an NRRD file with attached data
/// (raw, gzip or text) or an HDF5 file with a dataset `labels` of shape (nz, ny, nx) whose
/// attributes `origin` and `spacing` say where voxel (0, 0, 0) has its centre and how far the next
/// one is, in the units of the mesh. The format is recognised by content. Values are returned as
/// they are. See docs/segmentation.md for the fields that are understood.
///
/// Throws InputError for a file that is missing, cut short, damaged, of another format or of a kind
/// that is not supported (axes that are not x, y, z, voxels that are no cubes, values that are no
/// integers or no 32-bit numbers), and before any memory is taken for a volume that does not fit
/// into what is available; the message names the file, the field and its value.
VoxelGrid<std::int32_t> read_label_volume(const std::filesystem::path& file);

}  // namespace fracbench
