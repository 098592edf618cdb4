#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/material.h"
#include "methods/modes/group_sparse_admm.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

/// One displacement per tet, one component: sum over interior faces of area * |u_a - u_b|, and the
/// tets' volumes as masses. The directions of a vector displacement decouple: see fracture_modes.h.
GroupSparseEnergy constant_energy(const TetMesh& mesh);

struct ElasticScale {
  Material material = {};
  /// How far a crack opens when its energy is compared with that of the strain, as a share of the
  /// body's longest side.
  double opening = 0.01;
};

/// A linear displacement in every tet, with component k of corner j of tet t in row 12 t + 3 j + k:
///     s / 2 * integral of (lambda tr(e)^2 + 2 mu e : e) / E + sum over faces of sqrt(area) *
///     |jump|
/// with e the strain, lambda, mu and E the material's, s = E * opening / strength, and |jump| the
/// L2 norm over the face of the difference of the two displacements, which is integrated exactly.
/// For displacements that are constant in every tet that is the energy above. Lengths are those of
/// the unit box: the physical energy of strain and of a cohesive crack that opens against the
/// strength, over strength * opening * size^3.
GroupSparseEnergy elastic_energy(const TetMesh& mesh, const ElasticScale& scale);

/// lambda + 2 mu over E, times s: the penalty at which the jumps of an elastic field are as stiff
/// as its strains.
double matching_penalty(const ElasticScale& scale);

/// Per tet the part of the mesh it belongs to; parts share no face.
std::vector<std::int32_t> connected_parts(const TetMesh& mesh);

}  // namespace fracbench::modes
