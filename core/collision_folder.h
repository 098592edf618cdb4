#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/impact.h"

namespace fracbench {

/// A collision whose fragments some tool has made.
struct StoredCollision {
  std::string name;                                  ///< of its folder
  std::filesystem::path folder;                      ///< of the fragments
  std::vector<GivenImpulse> impulses;                ///< strongest first
  std::vector<std::filesystem::path> files() const;  ///< all that is in the folder, by name
};

/// Reads a folder with a folder for each collision, in the order of their names (docs/import.md).
/// Impulses are in FOLDER/COLLISION/impulses.json, or for all collisions in FOLDER/impulses.json.
/// Directions are made unit vectors. Throws InputError, naming the file and what is wrong in it,
/// where there is no collision or one has no impulses.
std::vector<StoredCollision> read_collision_folder(const std::filesystem::path& folder);

}  // namespace fracbench
