#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "methods/modes/tet_mesh.h"

// Tets made by hand for the tests of the fracture modes.
namespace fracbench::test {

/// A box of nx * ny * nz cubes from `low` to `high`, each cut into six tets (Kuhn), in the unit box
/// of the box itself.
modes::TetMesh tet_block(const std::array<int, 3>& cubes, const Vec3& low, const Vec3& high);

/// The same tets with every vertex moved by up to `share` of the cubes' shortest side.
modes::TetMesh shaken(const modes::TetMesh& tets, double share, Random& random);

/// The surface of the tets, in the body's frame.
TriangleMesh surface_of(const modes::TetMesh& tets);

/// A region for every tet: that of the nearest of `count` sites in the block.
std::vector<std::int32_t> voronoi_regions(const modes::TetMesh& tets, int count, Random& random);
/// Every tet for itself.
std::vector<std::int32_t> random_regions(const modes::TetMesh& tets, int count, Random& random);
/// Slabs of equal thickness across x.
std::vector<std::int32_t> slabs(const modes::TetMesh& tets, int count);

Vec3 centroid(const modes::TetMesh& tets, std::size_t tet);

}  // namespace fracbench::test
