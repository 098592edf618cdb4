#pragma once

#include "core/triangle_mesh.h"

namespace fracbench::cvd {

/// How often a closed mesh winds around a point: 1 inside a solid, 0 outside (solid angles by van
/// Oosterom and Strackee, "The solid angle of a plane triangle", 1983). Linear in the faces.
double winding_number(const TriangleMesh& mesh, const Vec3& point);

/// The part of it that is due to one triangle.
double winding_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point);

}  // namespace fracbench::cvd
