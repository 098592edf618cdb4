#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench::formats {

/// Some faces of a mesh, ready to be drawn: a vertex for every different pair of place and normal.
struct ShadedFaces {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;  ///< unit, parallel to positions
  std::vector<std::uint32_t> indices;    ///< three per face
};

/// The chosen faces, each with its own normal.
ShadedFaces flat_shaded(const TriangleMesh& mesh, std::span<const std::int32_t> faces);

/// The chosen faces with normals averaged over the chosen faces around a vertex, weighted by their
/// angles there (Thuermer and Wuethrich, 1998), but not over creases sharper than 40 degrees.
ShadedFaces smooth_shaded(const TriangleMesh& mesh, std::span<const std::int32_t> faces);

}  // namespace fracbench::formats
