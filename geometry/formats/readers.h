#pragma once

#include "core/triangle_mesh.h"
#include "geometry/formats/text_line.h"

// One reader per format. All throw InputError and take nothing on trust: counts are checked against
// the size of the file before memory is asked for. The result may still be empty.
namespace fracbench::formats {

/// Wavefront OBJ: v and f lines; texture coordinates, normals, groups, lines and materials are
/// passed over.
TriangleMesh read_obj(const Source& source);

/// Geomview OFF, text; colours, normals and texture coordinates are passed over.
TriangleMesh read_off(const Source& source);

/// Stanford PLY, text or binary of either byte order: x, y, z of the element vertex and
/// vertex_index or vertex_indices of the element face; everything else is passed over.
TriangleMesh read_ply(const Source& source);

/// STL, text or binary; equal vertices become one.
TriangleMesh read_stl(const Source& source);

/// Whether the bytes are those of a whole binary STL file, by their number.
bool is_binary_stl(std::string_view bytes);

}  // namespace fracbench::formats
