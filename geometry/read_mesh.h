#pragma once

#include <filesystem>
#include <string_view>

#include "core/triangle_mesh.h"

namespace fracbench {

/// Reads an OBJ, STL (text or binary), PLY (text or binary) or OFF file, recognised by content
/// where the format allows it, else by extension. Polygons are triangulated; the vertices of STL
/// files, which have no indices, are welded where they are bitwise equal. Nothing else is changed:
/// indices stay those of the file.
/// Throws InputError for a file that is missing, cut short, not a mesh, or holds NaN, infinite or
/// out-of-range values; the message names the file and the line or element.
TriangleMesh read_mesh(const std::filesystem::path& file);

/// The same from bytes that are in memory; `name` stands for the file, extension included.
TriangleMesh mesh_from_bytes(std::string_view bytes, const std::filesystem::path& name);

}  // namespace fracbench
