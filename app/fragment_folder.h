#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/fragments.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// Writes fragment_000.<format>, fragment_001.<format>, ..., fragments.glb and result.json. The
/// folder appears whole or not at all; an earlier result there is replaced. Throws InputError for
/// a folder that holds anything else, and where it cannot be written.
void write_fragment_folder(const std::filesystem::path& folder, const Fragments& fragments,
                           const std::string& format, const nlohmann::ordered_json& result);

/// Throws InputError where write_fragment_folder would refuse the folder; for use before long work.
void require_usable_folder(const std::filesystem::path& folder);

/// The meshes of a folder (OBJ, PLY, STL, OFF; in the order of their names), or the connected
/// solids of one mesh file. Throws InputError where there are none.
std::vector<TriangleMesh> read_fragment_meshes(const std::filesystem::path& path);

}  // namespace fracbench
