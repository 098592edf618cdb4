#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vec3.h"

namespace fracbench {

/// Three indices into TriangleMesh::vertices, counter-clockwise seen from outside.
using Face = std::array<std::int32_t, 3>;

/// An indexed triangle mesh. Nothing is promised beyond the two arrays: see geometry/check_mesh.h.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Face> faces;

  bool empty() const { return faces.empty(); }
  const Vec3& corner(std::size_t face, int k) const { return vertices[faces[face][k]]; }
};

}  // namespace fracbench
