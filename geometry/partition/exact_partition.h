#pragma once

#include "core/triangle_mesh.h"
#include "geometry/partition/interfaces.h"
#include "geometry/partition/label_lattice.h"
#include "geometry/partition_by_labels.h"

namespace fracbench::partition {

/// The reference for the fast path: the closed surface of each region, from interfaces extracted
/// with the void, is intersected with the body by CGAL's corefinement, region by region. Small
/// parts are not merged. Pieces on both sides of an interface cover the same area, but divide it
/// into other triangles. Throws MethodFailure where CGAL cannot answer.
Partition exact_partition(const TriangleMesh& body, const InterfaceMesh& interfaces,
                          const LabelLattice& lattice, int threads);

}  // namespace fracbench::partition
