#pragma once

#include <functional>

#include "core/triangle_mesh.h"

// Slow answers by other ways than those of the program, to compare with.
namespace fracbench::reference {

/// Distance to the nearest of all triangles, each as a plane region and three segments.
double distance(const TriangleMesh& mesh, const Vec3& query);

/// Sum of the solid angles of the faces over 4 pi (Van Oosterom and Strackee, 1983).
double winding_number(const TriangleMesh& mesh, const Vec3& query);

/// Positive inside.
double signed_distance(const TriangleMesh& mesh, const Vec3& query);

/// Of the box [low, high], closed form, positive inside.
double box_signed_distance(const Vec3& low, const Vec3& high, const Vec3& query);

}  // namespace fracbench::reference
