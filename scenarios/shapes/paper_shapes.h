#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/triangle_mesh.h"

namespace fracbench {

/// What does not change when a mesh is moved, scaled, turned by right angles or remeshed.
struct ShapeSignature {
  double volume = 0;       ///< over the cube of the longest side of the bounding box
  double middle_side = 0;  ///< over the longest
  double shortest_side = 0;

  bool matches(const ShapeSignature& other) const;
};

ShapeSignature signature(const TriangleMesh& mesh);

/// A shape of the DeepFracture paper, which the user has to bring.
struct PaperShape {
  std::string_view name;
  std::string_view summary;
  int thing = 0;  ///< number on Thingiverse
  int file = 0;   ///< number in Thingi10K; 0: the paper does not say
  ShapeSignature signature;
};

std::span<const PaperShape> paper_shapes();

/// The folder of the environment variable FRACBENCH_SHAPES; empty where it is not set.
std::filesystem::path shapes_folder();

/// The first file in `folder` whose mesh has the shape's signature, whatever it is called; files
/// with a number or the name of the shape in their name are tried first. Of the others no more than
/// some hundred are read.
std::optional<std::filesystem::path> find_paper_shape(const PaperShape& shape,
                                                      const std::filesystem::path& folder);

/// Where the shape comes from and what to set.
std::string how_to_get(const PaperShape& shape);

}  // namespace fracbench
