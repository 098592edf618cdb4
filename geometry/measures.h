#pragma once

#include "core/triangle_mesh.h"

namespace fracbench {

/// Exact integrals over the polyhedron that a closed mesh bounds, with unit density: the signed
/// tetrahedra between the faces and the centre of the bounding box, in compensated sums (as in
/// Tonon, "Explicit exact formulas for the 3-D tetrahedron inertia tensor", 2005). A mesh of volume
/// 0 has no centre of mass: the centre of its box stands in, with zero inertia.
struct MassProperties {
  double volume = 0;            ///< m^3, negative for an inverted mesh
  Vec3 center = Vec3::Zero();   ///< centre of mass, m
  Mat3 inertia = Mat3::Zero();  ///< about the centre, m^5; times density gives kg m^2
};

MassProperties mass_properties(const TriangleMesh& mesh);

/// Signed volume, m^3.
double volume(const TriangleMesh& mesh);

/// Surface area, m^2.
double area(const TriangleMesh& mesh);

/// Twice the area times the outward normal of a face, m^2.
Vec3 area_vector2(const TriangleMesh& mesh, std::size_t face);

struct BoundingBox {
  Vec3 low = Vec3::Constant(0);
  Vec3 high = Vec3::Constant(0);
  Vec3 center() const { return (low + high) / 2; }
  double longest_side() const { return (high - low).maxCoeff(); }
};

/// Of the corners of the faces: vertices that no face uses do not count. A mesh without faces has
/// the box (0, 0).
BoundingBox bounding_box(const TriangleMesh& mesh);

/// The mesh moved and scaled so that its box is centred at the origin and its longest side is
/// `longest_side`; returned bit for bit where it is already so within 1e-6 of that length, or
/// where it has no extent.
TriangleMesh normalized(const TriangleMesh& mesh, double longest_side);

}  // namespace fracbench
