#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/fragments.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// What a command found out; that it is there tells an earlier result from other folders.
inline constexpr const char* kResultFile = "result.json";

/// Writes fragment_000.<format>, fragment_001.<format>, ..., fragments.glb (where there are any)
/// and the documents, by the names of their files, of which kResultFile must be one. The folder
/// appears whole or not at all; an earlier result there is replaced. Throws InputError for a folder
/// that holds anything else, and where it cannot be written.
void write_fragment_folder(const std::filesystem::path& folder, const Fragments& fragments,
                           const std::string& format,
                           const std::map<std::string, nlohmann::ordered_json>& documents);

/// Throws InputError where write_fragment_folder would refuse the folder; for use before long work.
void require_usable_folder(const std::filesystem::path& folder);

}  // namespace fracbench
