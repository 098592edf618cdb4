#pragma once

#include <filesystem>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// By the ending of its name: OBJ, PLY, STL or OFF.
bool is_mesh_file(const std::filesystem::path& file);

/// The mesh files of a folder, in the order of their names.
std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& folder);

/// The meshes of a folder, in the order of their names, or the connected solids of one mesh file.
/// Throws InputError where there are none, and for a file that is no mesh.
std::vector<TriangleMesh> read_fragment_meshes(const std::filesystem::path& path);

}  // namespace fracbench
