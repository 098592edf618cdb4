#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "geometry/formats/text_line.h"

namespace fracbench::formats {

/// Faces with any number of corners.
struct Polygons {
  std::vector<Vec3> vertices;
  std::vector<std::int32_t> corners;  ///< of all faces, one after the other
  std::vector<std::size_t> ends;      ///< per face: where its corners end

  void reserve_faces(std::size_t count) {
    ends.reserve(count);
    corners.reserve(3 * count);
  }
};

/// All faces as triangles, in their order. Fails where a face has fewer than three corners, or more
/// than `most_corners`; the indices must be in range.
TriangleMesh triangulated(Polygons polygons, const Source& source);

/// A plane polygon, convex or not, as triangles with indices into `corners`, turned as it is:
/// ear clipping with exact predicates in the coordinate plane that the polygon faces most; of all
/// ears the one with the shortest cut. No corner is lost, also where corners are on one line. A
/// polygon that crosses itself or is not plane gives triangles that fill it as well as may be.
std::vector<Face> triangulated_polygon(std::span<const Vec3> corners);

constexpr std::size_t most_corners = 10000;

}  // namespace fracbench::formats
