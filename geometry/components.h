#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// For each face the number of its component (faces connected over shared edges), numbered from 0
/// in the order of their first face.
std::vector<std::int32_t> face_components(const TriangleMesh& mesh);

/// A part of a mesh, and where each of its faces came from.
struct MeshPart {
  TriangleMesh mesh;
  std::vector<std::int32_t> source_face;  ///< parallel to mesh.faces
};

/// The faces for which `selected` is not 0, with the vertices they use, in their order.
MeshPart extract_faces(const TriangleMesh& mesh, const std::vector<std::uint8_t>& selected);

/// The connected solids of a closed mesh: each outer shell together with the shells of the cavities
/// in it, so that the volumes of the parts are all positive and add up to the whole.
std::vector<MeshPart> solid_components(const TriangleMesh& mesh);

/// The faces of each solid of a closed mesh whose shells are known: the shells themselves, without
/// a further look, unless one of them bounds a cavity.
std::vector<std::vector<std::int32_t>> solids_of_shells(
    const TriangleMesh& mesh, std::vector<std::vector<std::int32_t>> shells);

}  // namespace fracbench
