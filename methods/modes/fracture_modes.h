#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/context.h"
#include "core/material.h"
#include "methods/modes/tet_mesh.h"

namespace fracbench::modes {

struct ModesOptions {
  int count = 10;                     ///< modes wanted, without the motions that open no face
  int dimension = 3;                  ///< 1: scalar displacement; 3: vectors. Elastic modes have 3.
  bool elastic = false;               ///< linear displacement in every tet, and its elastic energy
  Material material = {};             ///< elastic modes: stiffness and strength
  double opening = 0.01;              ///< elastic modes: see elastic_energy in modes_problem.h
  double jump_threshold = 0.1;        ///< tets are joined across faces whose jump is smaller
  double iteration_tolerance = 1e-4;  ///< of the outer iteration: max |dc|
  int iterations = 10;                ///< of the outer iteration, at most
  double residual_tolerance = 1e-5;   ///< of each convex problem, relative, primal and dual
  double gap_tolerance = 1e-4;        ///< of each mode's last convex problem: relative duality gap
};

/// The fracture modes of a tet mesh, in the order in which they were found. Displacements have unit
/// mass norm, sum over the tets of volume * |u|^2 = 1 (elastic: the integral of |u|^2).
struct FractureModes {
  int dimension = 3;  ///< d: components per tet
  /// (d * tets) x modes; component k of tet t is row d * t + k. Elastic modes: of the tet's
  /// centroid.
  Eigen::MatrixXd displacement;
  /// (12 * tets) x modes for elastic modes, else empty: component k of corner j is row
  /// 12 * t + 3 * j + k.
  Eigen::MatrixXd corner_displacement;
  std::vector<double> energies;  ///< per mode, of the normalised displacement
  /// Per mode, the piece of each tet: 0, 1, ... in the order of their first tets.
  std::vector<std::vector<std::int32_t>> pieces;
  std::vector<std::int32_t> piece_counts;  ///< per mode
  std::vector<int> iterations;             ///< per mode, outer iterations
  std::vector<double> gaps;                ///< per mode, relative duality gap of the last of them
};

/// Sellan et al. 2023, "Breaking Good": see docs/methods/modes.md for the energy and the iteration.
/// The motions that open no face (d translations of each connected part; elastic: its 6 rigid
/// motions) are not returned, and all modes are orthogonal to them and to each other under the mass
/// matrix.
///
/// With one displacement per tet, a problem whose normalisation c and earlier modes each lie along
/// one axis has a solution along the axis of c: the components of any other solution across it can
/// be turned around (u_y -> -u_y changes neither energy nor constraints), and the mean of the two
/// has no more energy. The modes of dimension 3 are therefore those of dimension 1, each along x, y
/// and z in turn, and are computed that way.
///
/// Deterministic; the same bytes for any number of threads of the context.
/// Throws InputError for options out of range and where the mesh has too few tets for that many
/// modes; MethodFailure where a convex problem does not converge.
FractureModes compute_modes(const TetMesh& mesh, const ModesOptions& options, Context& context);

/// The pieces of one displacement field ((d * tets) values): tets joined across the interior faces
/// whose jump is smaller than `threshold`; numbered in the order of their first tets.
std::vector<std::int32_t> pieces_of(const TetMesh& mesh, const Eigen::VectorXd& displacement,
                                    int dimension, double threshold);

}  // namespace fracbench::modes
