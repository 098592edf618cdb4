#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "core/voxel_grid.h"

namespace fracbench {

/// Values on the vertices or faces of a mesh.
struct VtkArray {
  std::string name;
  int components = 1;
  std::vector<float> values;  ///< components of the first vertex or face, of the second, ...
};

struct VtkData {
  std::vector<VtkArray> on_vertices;
  std::vector<VtkArray> on_faces;
};

/// Writes a mesh with values as VTK XML PolyData (.vtp), which ParaView opens: appended raw data,
/// points as doubles. Throws InputError where the file cannot be written, std::logic_error where an
/// array has another length than the mesh.
void write_vtp(const std::filesystem::path& path, const TriangleMesh& mesh,
               const VtkData& data = {});

/// Writes a label volume as VTK XML ImageData (.vti), the labels as an Int32 array "label".
void write_vti(const std::filesystem::path& path, const VoxelGrid<std::int32_t>& labels);

}  // namespace fracbench
