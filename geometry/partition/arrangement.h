#pragma once

#include <array>
#include <cstdint>
#include <functional>
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

/// The region around a point that lies on no interface; asked for a vertex of the body in each part
/// of its surface that no interface meets.
using RegionAt = std::function<std::int32_t(const Vec3& point)>;

/// `body` must be closed and free of self-intersections. Throws NotGeneric.
Arrangement arrange(const TriangleMesh& body, const InterfaceMesh& interfaces,
                    const Crossings& crossings, const LabelLattice& lattice, int threads);

/// The same for interfaces that come from no lattice.
Arrangement arrange(const TriangleMesh& body, const InterfaceComplex& interfaces,
                    const Crossings& crossings, const RegionAt& region_at, int threads);

}  // namespace fracbench::partition
