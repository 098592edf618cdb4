#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/material.h"
#include "methods/bem/boundary_elements.h"

namespace fracbench::bem {

/// The stress that displacements and tractions on a surface make off it (Somigliana's stress
/// identity): for a closed body the stress inside and zero outside. Displacements are those of
/// elastic_operator.h: continuous and linear on each triangle, for a crack minus its opening.
/// Integrated by parts, the identity needs only r / |r|^3 and r r r / |r|^5 over each triangle:
/// three points where the triangle is more than 5 of its radii away, in closed form otherwise. At
/// the surface itself the field is discontinuous, and infinite (logarithm) on edges.
class SomiglianaStress {
 public:
  /// `displacements`: three per vertex, m. `tractions`: 3 x triangles, Pa.
  SomiglianaStress(const BoundaryElements& elements, const Eigen::VectorXd& displacements,
                   const Eigen::Matrix3Xd& tractions, const Material& material);

  struct Value {
    Mat3 stress = Mat3::Zero();  ///< Pa
    double inside = 0;           ///< 1 inside a closed surface, 0 outside
  };
  Value at(const Vec3& x) const;

 private:
  /// Triangles side by side, for the far field.
  static constexpr int kLanes = 8;
  struct alignas(64) Group {
    double points[9][kLanes];  ///< three points of three coordinates
    double centroid[3][kLanes];
    double near_squared[kLanes];  ///< squared distance within which the closed form is taken
    double third_area[kLanes];
    double kelvin[3][kLanes];  ///< density of Kelvin's solution: t - 2 mu M u
    double curl[3][kLanes];    ///< density of 1/r: M u
    double shear[9][kLanes];   ///< surface curl of u: component k of that of u_i at 3 i + k
    double normal[3][kLanes];
  };
  struct Sums;

  /// Sums over the triangles that are far from x; marks the others, which count nothing.
  static void add_groups(const Group* begin, const Group* end, const Vec3& x, Sums& sums,
                         unsigned char* near);

  BoundaryElements elements_;
  Material material_;
  std::vector<Group> groups_;
  std::vector<Vec3> kelvin_;
  std::vector<Vec3> curl_;
  std::vector<Mat3> shear_;  ///< row i: surface curl of u_i
};

}  // namespace fracbench::bem
