#include "tests/methods/cvd/bodies.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "geometry/measures.h"
#include "geometry/read_mesh.h"
#include "source_folder.h"

namespace fracbench::test {

TriangleMesh boxes(int nx, int ny, int nz, const std::function<bool(int, int, int)>& solid) {
  const auto filled = [&](int i, int j, int k) {
    return i >= 0 && j >= 0 && k >= 0 && i < nx && j < ny && k < nz && solid(i, j, k);
  };
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> number;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [entry, fresh] =
        number.try_emplace(at, static_cast<std::int32_t>(mesh.vertices.size()));
    if (fresh) mesh.vertices.emplace_back(at[0], at[1], at[2]);
    return entry->second;
  };
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      for (int k = 0; k < nz; ++k) {
        if (!filled(i, j, k)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int side : {0, 1}) {
            std::array<int, 3> beyond{i, j, k};
            beyond[axis] += 2 * side - 1;
            if (filled(beyond[0], beyond[1], beyond[2])) continue;
            std::array<std::int32_t, 4> quad{};
            for (int c = 0; c < 4; ++c) {
              std::array<int, 3> at{i, j, k};
              at[axis] += side;
              at[(axis + 1) % 3] += c == 1 || c == 2;
              at[(axis + 2) % 3] += c == 2 || c == 3;
              quad[side == 1 ? c : 3 - c] = vertex(at);
            }
            mesh.faces.push_back({quad[0], quad[1], quad[2]});
            mesh.faces.push_back({quad[0], quad[2], quad[3]});
          }
        }
      }
    }
  }
  return normalized(mesh, 1.9);
}

TriangleMesh cube(int n) {
  TriangleMesh mesh = boxes(n, n, n, [](int, int, int) { return true; });
  for (Vec3& v : mesh.vertices) {
    for (int c = 0; c < 3; ++c) v[c] = std::round((v[c] / 1.9 + 0.5) * n) * 2 / n - 1;
  }
  return mesh;
}

TriangleMesh sphere(int levels) {
  TriangleMesh mesh;
  mesh.vertices = {Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                   Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};
  mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::array<std::int32_t, 2>, std::int32_t> middle;
    const auto between = [&](std::int32_t a, std::int32_t b) {
      const auto [entry, fresh] = middle.try_emplace(
          {std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(mesh.vertices.size()));
      if (fresh) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return entry->second;
    };
    std::vector<Face> faces;
    for (const auto& [a, b, c] : mesh.faces) {
      const std::int32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
      faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.faces = std::move(faces);
  }
  for (Vec3& v : mesh.vertices) v *= 0.95;
  return mesh;
}

TriangleMesh rotated(const TriangleMesh& mesh, const Mat3& rotation) {
  TriangleMesh result = mesh;
  for (Vec3& v : result.vertices) v = rotation * v;
  return result;
}

std::vector<Body> generated_bodies() {
  const auto within = [](int x, int low, int high) { return x >= low && x <= high; };
  std::vector<Body> bodies;
  bodies.push_back({"cube", cube(4)});
  bodies.push_back({"sphere", sphere(4)});
  bodies.push_back({"angle", boxes(6, 6, 3, [](int i, int j, int) { return i < 2 || j < 2; })});
  bodies.push_back({"hollow cube", boxes(5, 5, 5, [&](int i, int j, int k) {
                      return !(within(i, 1, 3) && within(j, 1, 3) && within(k, 1, 3));
                    })});
  bodies.push_back({"cube in a shell", boxes(7, 7, 7, [&](int i, int j, int k) {
                      const int layer = std::min({i, j, k, 6 - i, 6 - j, 6 - k});
                      return layer != 1;
                    })});
  bodies.push_back({"thin cup", boxes(20, 20, 20, [&](int i, int j, int k) {
                      return k == 0 || i == 0 || j == 0 || i == 19 || j == 19;
                    })});
  bodies.push_back({"ring", boxes(6, 6, 2, [&](int i, int j, int) {
                      return !(within(i, 2, 3) && within(j, 2, 3));
                    })});
  bodies.push_back({"frame of a cube", boxes(7, 7, 7, [&](int i, int j, int k) {
                      return within(i, 2, 4) + within(j, 2, 4) + within(k, 2, 4) <= 1;
                    })});
  return bodies;
}

std::vector<Body> filed_bodies() {
  std::vector<Body> bodies;
  for (const char* name : {"squirrel", "base", "mug", "pot_standin", "spot", "bunny"}) {
    const auto file = std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes" /
                      (std::string(name) + ".obj");
    if (std::filesystem::exists(file)) bodies.push_back({name, read_mesh(file)});
  }
  return bodies;
}

}  // namespace fracbench::test
