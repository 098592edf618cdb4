#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench::bem {

/// The three corners of a flat triangle, m.
using Corners = std::array<Vec3, 3>;

/// A surface of flat triangles as the boundary element method sees it: a closed body or the sheets
/// of cracks. Displacements (for a crack: minus its opening) are linear on each triangle, with
/// values at the vertices; tractions are constant on each triangle.
struct BoundaryElements {
  std::vector<Vec3> vertices;
  std::vector<Face> triangles;
  std::vector<double> areas;    ///< m^2
  std::vector<Vec3> normals;    ///< unit vectors
  std::vector<Vec3> centroids;  ///< m
  std::vector<double> radii;    ///< largest distance of a corner from the centroid, m
  /// n x gradient of each corner's hat function, 1/m: constant on the triangle.
  std::vector<std::array<Vec3, 3>> curls;

  std::size_t size() const { return triangles.size(); }
  /// Unknowns: three for each vertex, those of vertex v at 3 v, 3 v + 1 and 3 v + 2.
  std::size_t unknowns() const { return 3 * vertices.size(); }
  Corners corners(std::size_t triangle) const {
    const Face& face = triangles[triangle];
    return {vertices[face[0]], vertices[face[1]], vertices[face[2]]};
  }
};

/// Throws InputError where a triangle has no area (height below 1e-9 of its longest side) or a
/// coordinate is not finite.
BoundaryElements make_boundary_elements(const TriangleMesh& mesh);

/// Several surfaces as one; vertices and triangles keep their order. Vertices at the same place
/// stay apart: each has unknowns of its own.
BoundaryElements join_boundary_elements(std::span<const BoundaryElements> parts);

/// The triangles around each vertex, ascending.
std::vector<std::vector<std::int32_t>> triangles_around_vertices(const BoundaryElements& elements);

}  // namespace fracbench::bem
