#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/options.h"
#include "core/triangle_mesh.h"

namespace fracbench {

struct ShapeInfo {
  std::string name;
  std::string summary;
  std::string source;  ///< "generated", "package", "file": where it comes from
  bool available = true;
  std::string how_to_get;  ///< where it is not available: where it comes from, what to set
};

/// All shapes that have a name, whether they are there or not.
std::vector<ShapeInfo> list_shapes();

struct ShapeRequest {
  std::string name;           ///< a name from list_shapes(), or the path of a mesh file
  int resolution = 0;         ///< generated shapes: subdivisions along the longest side; 0: default
  double longest_side = 1.9;  ///< m; 0: keep the file's own scale and place
};

struct Shape {
  std::string name;                ///< the name, or the file's stem
  TriangleMesh mesh;               ///< closed, manifold, outward, free of self-intersections
  std::vector<std::string> notes;  ///< what was welded, reoriented or scaled
};

/// The mesh of a named or filed shape, scaled so that the longest side of its bounding box is
/// `longest_side` and its box is centred at the origin; files are checked. What the safe repairs of
/// geometry/repair_mesh.h mend is mended and noted; a mesh that is inside out is refused like one
/// that is open, since turning it would be a guess. A name goes before a file of that name. Throws
/// InputError with the reason and the way out where the shape is missing or not a solid.
Shape load_shape(const ShapeRequest& request);

}  // namespace fracbench
