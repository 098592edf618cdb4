#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

// Small meshes whose properties are known, for the tests of this room.
namespace fracbench::test_meshes {

/// A box with two triangles per side, outward oriented.
TriangleMesh box(const Vec3& low, const Vec3& high);
TriangleMesh cube(double side = 2);

/// The corner tetrahedron (0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1).
TriangleMesh tetrahedron();

/// A latitude-longitude sphere with 2 * slices * (stacks - 1) faces, vertices on the sphere.
TriangleMesh sphere(int stacks, int slices, double radius = 1, const Vec3& center = Vec3::Zero());

/// Around the z axis; 2 * major * minor faces.
TriangleMesh torus(int major, int minor, double major_radius = 1, double minor_radius = 0.3);

/// One-sided: closed along its length, open at its rim.
TriangleMesh moebius_strip(int segments);

/// A cube without its top.
TriangleMesh open_box();

TriangleMesh flipped(TriangleMesh mesh);
TriangleMesh mapped(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& motion);
TriangleMesh moved(TriangleMesh mesh, const Vec3& by);

/// All meshes in one, sharing no vertices.
TriangleMesh joined(const std::vector<TriangleMesh>& meshes);
/// Vertices that are equal become one.
TriangleMesh welded(const TriangleMesh& mesh);

/// A cube with a cubic cavity.
TriangleMesh hollow_cube();
/// Solid spheres in the cavities of larger ones: shells of radius 1, 2, ..., count.
TriangleMesh nested_spheres(int count);

struct Named {
  std::string name;
  TriangleMesh mesh;
};

/// Solids of every kind: convex, genus 1, with cavities, several components, thin, tiny, far away.
std::vector<Named> solids();

/// A file of the folder of development shapes; empty where it is not there.
std::filesystem::path shared_mesh(const std::string& file);

}  // namespace fracbench::test_meshes
