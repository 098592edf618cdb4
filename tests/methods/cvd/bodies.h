#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench::test {

struct Body {
  std::string name;
  TriangleMesh mesh;
};

/// The boundary of the unit boxes (i, j, k) of a grid for which `solid` is true, scaled so that the
/// longest side is 1.9 and centred at the origin.
TriangleMesh boxes(int nx, int ny, int nz, const std::function<bool(int, int, int)>& solid);

/// A cube of side 2 about the origin, each side divided n times.
TriangleMesh cube(int n);

/// A sphere of radius 0.95 (octahedron, divided `levels` times).
TriangleMesh sphere(int levels);

TriangleMesh rotated(const TriangleMesh& mesh, const Mat3& rotation);

/// Convex, concave, hollow, two in one another, thin-walled, of genus 1 and 5; all closed and
/// manifold.
std::vector<Body> generated_bodies();

/// The meshes of the development folder, where it is there.
std::vector<Body> filed_bodies();

}  // namespace fracbench::test
