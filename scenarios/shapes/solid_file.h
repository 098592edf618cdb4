#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// A solid from a file, and what was done to it to make it one.
struct SolidFile {
  TriangleMesh mesh;
  std::vector<std::string> notes;
};

/// Reads a mesh file that must hold a solid. Where it does not, the safe repairs of repair_mesh are
/// tried, and noted; they include faces that are wound against their neighbours. A shell whose
/// faces agree but look inwards is not turned: whether it is inside out or a cavity, turning it
/// would be a guess.
/// Throws InputError with what is wrong, where, and what to do.
SolidFile read_solid(const std::filesystem::path& file);

}  // namespace fracbench
