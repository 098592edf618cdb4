#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "core/context.h"
#include "core/material.h"
#include "methods/bem/boundary_elements.h"

namespace fracbench::bem {

/// What an elastic body of so many triangles takes, predicted from measurements on one core of the
/// project's reference machine.
struct ElasticCost {
  std::uint64_t bytes = 0;      ///< at the peak
  double assembly_seconds = 0;  ///< on one thread; grows as triangles^2
  double factor_seconds = 0;    ///< on one thread; grows as triangles^3
  double seconds(int threads) const { return (assembly_seconds + factor_seconds) / threads; }
};

/// For a closed surface of `triangles` triangles.
ElasticCost predict_cost(std::size_t triangles);

/// An elastic body free in space, ready to answer to any load on its surface: the hypersingular
/// operator D of its surface, factorised once. Rigid motions, which D leaves free, are held by
/// D + alpha Q Q^T with orthonormal rigid motions Q and alpha = tr(D) / (unknowns). A surface in
/// several parts (a body with closed cavities) has six for each part: its displacements are then
/// known up to a rigid motion of each part, which changes no stress.
class ElasticBody {
 public:
  /// `mesh`: closed, outward oriented. Throws InputError where it is not closed, has triangles
  /// without area, the material is impossible (check_elastic_material) or the matrix does not fit
  /// into the memory that is available; MethodFailure where the factorisation fails. Stages of
  /// context.timer: assemble, factorise.
  ElasticBody(const TriangleMesh& mesh, const Material& material, Context& context);

  const BoundaryElements& elements() const { return elements_; }
  const Material& material() const { return material_; }
  /// Orthonormal rigid motions, unknowns x 6 for each part of the surface.
  const Eigen::MatrixXd& rigid_motions() const { return rigid_; }

  /// Displacements (m, three for each vertex) under tractions (Pa, 3 x triangles) that are in
  /// balance (what is not is left out); without rigid motion.
  Eigen::VectorXd displacements(const Eigen::Matrix3Xd& tractions, const Context& context) const;

  // Both solvers use the threads of the constructor's context where that pays.

  /// Replaces B by A^-1 B for A = D + alpha Q Q^T = L L^T; rows of B: unknowns.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> right_sides) const;
  /// Replaces B by L^-1 B, so that B^T A^-1 B is its product with itself.
  void solve_lower_in_place(Eigen::Ref<Eigen::MatrixXd> right_sides) const;

 private:
  void use_threads_for(Eigen::Index right_sides) const;

  BoundaryElements elements_;
  Material material_;
  int threads_ = 1;
  Eigen::MatrixXd rigid_;
  Eigen::MatrixXd factor_;  ///< L in the lower triangle; above it: not used
};

}  // namespace fracbench::bem
