#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// What is wrong with a mesh, with counts and up to ten places each. Meshes are judged by indices:
/// weld first where a file duplicates its vertices.
struct MeshReport {
  struct Finding {
    std::string kind;  ///< "open edge", "non-manifold vertex", ...
    std::size_t count = 0;
    std::vector<std::string> places;  ///< "edge 12-57 at (0.1, 0.2, 0.3)"
  };

  std::size_t vertices = 0;
  std::size_t faces = 0;
  std::size_t components = 0;  ///< connected over shared edges
  bool finite = true;          ///< no NaN or infinite vertex, every index in range
  bool closed = false;         ///< no edge has only one face
  bool manifold = false;       ///< edges have at most two faces, vertices one fan
  bool oriented = false;  ///< neighbours agree, and every component's volume has the right sign
                          ///< (outer shells positive, the shells of cavities negative)
  bool self_intersecting = false;
  bool degenerate_faces = false;  ///< zero area or a repeated vertex
  double volume = 0;              ///< m^3, signed
  std::vector<Finding> findings;

  /// A solid: finite, closed, manifold, oriented, positive volume, free of self-intersections.
  bool is_solid() const;
  /// One line per finding; "solid" where there is none.
  std::string describe() const;
};

struct CheckOptions {
  bool self_intersections = true;  ///< the slow part: about a second for 300,000 faces
  int threads = 2;
};

MeshReport check_mesh(const TriangleMesh& mesh, const CheckOptions& options = {});

/// Throws InputError with the report where the mesh is not a solid. `name` is the file or shape.
void require_solid(const TriangleMesh& mesh, std::string_view name,
                   const CheckOptions& options = {});

/// Pairs of faces that intersect other than in a shared vertex or edge, each pair once (i < j), in
/// ascending order; at most `limit` of them. Exact, for finite vertices and indices in range.
///
/// A vertex or edge is shared where its coordinates are equal, whatever its indices: surfaces that
/// touch there do not intersect, but they do where they cross there, that is, where the insides of
/// two solids overlap next to an edge that four or more faces share. Faces of zero area are left
/// out (check_mesh reports them).
std::vector<std::pair<std::int32_t, std::int32_t>> self_intersections(const TriangleMesh& mesh,
                                                                      int threads = 2,
                                                                      std::size_t limit = 1000);

}  // namespace fracbench
