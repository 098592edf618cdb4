#include "tests/geometry/test_meshes.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "source_folder.h"

namespace fracbench::test_meshes {

TriangleMesh box(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                               i & 4 ? high.z() : low.z());
  }
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh cube(double side) { return box(Vec3::Constant(-side / 2), Vec3::Constant(side / 2)); }

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  mesh.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

TriangleMesh sphere(int stacks, int slices, double radius, const Vec3& center) {
  TriangleMesh mesh;
  mesh.vertices.push_back(center + Vec3(0, 0, radius));
  for (int i = 1; i < stacks; ++i) {
    const double theta = std::numbers::pi * i / stacks;
    for (int j = 0; j < slices; ++j) {
      const double phi = 2 * std::numbers::pi * j / slices;
      mesh.vertices.push_back(center + radius * Vec3(std::sin(theta) * std::cos(phi),
                                                     std::sin(theta) * std::sin(phi),
                                                     std::cos(theta)));
    }
  }
  mesh.vertices.push_back(center - Vec3(0, 0, radius));
  const auto at = [&](int i, int j) { return 1 + (i - 1) * slices + j % slices; };
  const int bottom = static_cast<int>(mesh.vertices.size()) - 1;
  for (int j = 0; j < slices; ++j) {
    mesh.faces.push_back({0, at(1, j), at(1, j + 1)});
    for (int i = 1; i + 1 < stacks; ++i) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.faces.push_back({at(stacks - 1, j), bottom, at(stacks - 1, j + 1)});
  }
  return mesh;
}

TriangleMesh torus(int major, int minor, double major_radius, double minor_radius) {
  TriangleMesh mesh;
  for (int i = 0; i < major; ++i) {
    const double u = 2 * std::numbers::pi * i / major;
    for (int j = 0; j < minor; ++j) {
      const double v = 2 * std::numbers::pi * j / minor;
      const double r = major_radius + minor_radius * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), minor_radius * std::sin(v));
    }
  }
  const auto at = [&](int i, int j) { return (i % major) * minor + j % minor; };
  for (int i = 0; i < major; ++i) {
    for (int j = 0; j < minor; ++j) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh moebius_strip(int segments) {
  TriangleMesh mesh;
  for (int i = 0; i < segments; ++i) {
    const double u = 2 * std::numbers::pi * i / segments;
    for (const double s : {-0.3, 0.3}) {
      const double r = 1 + s * std::cos(u / 2);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), s * std::sin(u / 2));
    }
  }
  for (int i = 0; i < segments; ++i) {
    // The last segment meets the first with its sides exchanged.
    const bool last = i + 1 == segments;
    const int a = 2 * i, b = 2 * i + 1;
    const int c = last ? 1 : 2 * i + 2, d = last ? 0 : 2 * i + 3;
    mesh.faces.push_back({a, c, d});
    mesh.faces.push_back({a, d, b});
  }
  return mesh;
}

TriangleMesh open_box() {
  TriangleMesh mesh = cube();
  mesh.faces.erase(mesh.faces.begin() + 2, mesh.faces.begin() + 4);
  return mesh;
}

TriangleMesh flipped(TriangleMesh mesh) {
  for (Face& face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

TriangleMesh mapped(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& motion) {
  for (Vec3& v : mesh.vertices) v = motion(v);
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
  return mesh;
}

TriangleMesh joined(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh result;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::int32_t>(result.vertices.size());
    result.vertices.insert(result.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const Face& f : mesh.faces) {
      result.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
    }
  }
  return result;
}

TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::map<std::array<double, 3>, std::int32_t> known;
  std::vector<std::int32_t> target;
  for (const Vec3& v : mesh.vertices) {
    const auto [at, added] = known.try_emplace({v.x(), v.y(), v.z()}, result.vertices.size());
    if (added) result.vertices.push_back(v);
    target.push_back(at->second);
  }
  for (const Face& f : mesh.faces) {
    result.faces.push_back({target[f[0]], target[f[1]], target[f[2]]});
  }
  return result;
}

TriangleMesh hollow_cube() { return joined({cube(2), flipped(cube(1))}); }

TriangleMesh nested_spheres(int count) {
  std::vector<TriangleMesh> shells;
  for (int i = 1; i <= count; ++i) {
    TriangleMesh shell = sphere(8, 12, i);
    shells.push_back((count - i) % 2 == 0 ? shell : flipped(shell));
  }
  return joined(shells);
}

std::vector<Named> solids() {
  const auto turned = [](const TriangleMesh& mesh) {
    const Mat3 turn(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
    return mapped(mesh, [&](const Vec3& v) { return Vec3(turn * v); });
  };
  return {{"cube", cube()},
          {"turned box", turned(box(Vec3(-1, 0, 2), Vec3(2, 0.5, 2.25)))},
          {"tetrahedron", tetrahedron()},
          {"sphere", sphere(16, 24)},
          {"torus", torus(24, 12)},
          {"plate", box(Vec3(-1, -1, 0), Vec3(1, 1, 1e-6))},
          {"tiny sphere", sphere(6, 8, 1e-7)},
          {"far cube", moved(cube(), Vec3(1000, -2000, 500))},
          {"hollow cube", hollow_cube()},
          {"nested spheres", nested_spheres(5)},
          {"two cubes", joined({cube(), moved(cube(), Vec3(5, 0, 0))})},
          {"linked tori", joined({torus(24, 12), mapped(torus(24, 12), [](const Vec3& v) {
                                    return Vec3(v.x() + 1, v.z(), -v.y());
                                  })})}};
}

std::filesystem::path shared_mesh(const std::string& file) {
  const auto path = std::filesystem::path(FRACBENCH_SOURCE_DIR) / ".." / "shared" / "meshes" / file;
  return std::filesystem::exists(path) ? path : std::filesystem::path();
}

}  // namespace fracbench::test_meshes
