#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench::modes {

/// Four indices into TetMesh::vertices; det(b - a, c - a, d - a) > 0.
using Tet = std::array<std::int32_t, 4>;

/// The similarity that takes the body's frame to the unit box: longest side 1, centre at the
/// origin. unit = (body - center) / size.
struct UnitBox {
  Vec3 center = Vec3::Zero();
  double size = 1;  ///< longest side of the shape's bounding box, in the body's frame

  Vec3 to_unit(const Vec3& body) const { return (body - center) / size; }
  Vec3 to_body(const Vec3& unit) const { return unit * size + center; }
};

/// The unit box of a shape. Throws InputError for a mesh without vertices or without extent.
UnitBox unit_box(const TriangleMesh& shape);

/// A tetrahedral mesh of the unit-box frame, and how its tets touch.
struct TetMesh {
  struct InteriorFace {
    std::array<std::int32_t, 2> tets{-1, -1};         ///< tets[0] < tets[1]
    std::array<std::int32_t, 3> corners{-1, -1, -1};  ///< counter-clockwise seen from tets[1], so
                                                      ///< that the normal points out of tets[0]
    double area = 0;
  };
  struct BoundaryFace {
    std::int32_t tet = -1;
    std::array<std::int32_t, 3> corners{-1, -1, -1};  ///< counter-clockwise seen from outside
  };

  std::vector<Vec3> vertices;  ///< in the unit-box frame
  std::vector<Tet> tets;
  std::vector<double> volumes;               ///< parallel to tets, unit box
  std::vector<InteriorFace> interior_faces;  ///< ascending by their two tets
  std::vector<BoundaryFace> boundary_faces;  ///< ascending by tet
  UnitBox frame;                             ///< of the shape (not of the cage, which is larger)

  double volume() const;  ///< of all tets, unit box
};

/// Builds the adjacency, areas and volumes of tets given by their corners; turns tets that are
/// inside out. Throws MethodFailure for a tet without volume, an index out of range, or a face that
/// more than two tets share.
TetMesh make_tet_mesh(std::vector<Vec3> vertices, std::vector<Tet> tets, const UnitBox& frame = {});

}  // namespace fracbench::modes
