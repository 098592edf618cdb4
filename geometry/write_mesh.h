#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/fragments.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// Writes OBJ, PLY, STL (both binary) or glTF (.glb), by extension. OBJ holds the shortest
/// decimals and PLY 64-bit floats that give the same bits when read; STL and glTF are 32-bit by
/// format. The file appears whole or not at all. Throws InputError where it cannot be written (the
/// system's reason is in the message).
void write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh);

/// All fragments in one file: OBJ with a group per fragment, glTF with a node and a colour per
/// fragment, fracture surfaces in a material of their own, PLY with the integers 'part',
/// 'original_face' and 'interface' per face (see FragmentFace), STL with nothing but the faces.
void write_fragments(const std::filesystem::path& file, const Fragments& fragments);

}  // namespace fracbench
