#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/random.h"
#include "core/voxel_grid.h"
#include "geometry/partition_by_labels.h"

// Label volumes for the tests of the partition, and what must hold of every partition.
namespace fracbench::test_labels {

using Labels = VoxelGrid<std::int32_t>;

/// The grid of r samples along the longest side of the mesh's box, with one voxel to spare.
Labels grid_around(const TriangleMesh& mesh, int r);

Labels filled(Labels grid, const std::function<std::int32_t(int, int, int)>& label);
/// Nearest of `count` sites in the grid's box.
Labels voronoi(Labels grid, int count, Random& random);
/// Every voxel for itself, from 1 to count.
Labels noise(Labels grid, int count, Random& random);
/// Labels 1 and 2 in turn along all axes.
Labels checkerboard(Labels grid);
/// Slabs of one voxel across the x axis.
Labels slabs(Labels grid, int count);
/// A label of its own for every voxel.
Labels single_voxels(Labels grid);

struct Expectations {
  double volume_tolerance = 1e-12;  ///< of the sum, relative
  bool disjoint = true;             ///< test for overlaps, the slow part
  bool shared_interfaces = true;    ///< both sides of an interface are the same triangles
};

/// What the partition of `mesh` breaks, in words; empty: every piece is a solid, the volumes add
/// up, the pieces are disjoint, each face of the mesh is covered once by faces of the same plane,
/// the mesh's vertices are there bit for bit, and both sides of each interface agree.
std::string faults(const TriangleMesh& mesh, const Partition& partition,
                   const Expectations& expect = {});

}  // namespace fracbench::test_labels
