#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "geometry/partition/crossings.h"
#include "geometry/partition/interfaces.h"
#include "geometry/partition/label_lattice.h"

namespace fracbench::partition {

/// A body cut along interfaces: its surface by region, and the interfaces inside it.
struct Arrangement {
  struct BodyPart {
    Face corners;              ///< indices into `vertices`
    std::int32_t region = 0;   ///< that the body has behind it
    std::int32_t source = -1;  ///< face of the body
  };
  struct InterfacePart {
    Face corners;
    std::array<std::int32_t, 2> regions;  ///< the normal points from the first to the second
  };
  std::vector<Vec3> vertices;  ///< the body's, the interfaces', then the crossings
  std::vector<BodyPart> body;
  std::vector<InterfacePart> interfaces;
};

/// `body` must be closed and free of self-intersections. Throws NotGeneric.
Arrangement arrange(const TriangleMesh& body, const InterfaceMesh& interfaces,
                    const Crossings& crossings, const LabelLattice& lattice, int threads);

}  // namespace fracbench::partition
