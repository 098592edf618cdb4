#include "methods/bem/validation/smooth_bodies.h"

#include <array>
#include <map>
#include <numbers>
#include <utility>

namespace fracbench::bem {

TriangleMesh cube_surface(int cells) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      const auto vertex = [&](int i, int j) {
        std::array<int, 3> key;
        key[axis] = upper ? cells : 0;
        key[(axis + 1) % 3] = i;
        key[(axis + 2) % 3] = j;
        const auto [entry, is_new] =
            numbers.try_emplace(key, static_cast<std::int32_t>(mesh.vertices.size()));
        if (is_new) mesh.vertices.push_back(Vec3(key[0], key[1], key[2]) / cells);
        return entry->second;
      };
      for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
          const std::int32_t a = vertex(i, j);
          const std::int32_t b = vertex(i + 1, j);
          const std::int32_t c = vertex(i + 1, j + 1);
          const std::int32_t d = vertex(i, j + 1);
          mesh.faces.push_back(upper ? Face{a, b, c} : Face{a, c, b});
          mesh.faces.push_back(upper ? Face{a, c, d} : Face{a, d, c});
        }
      }
    }
  }
  return mesh;
}

TriangleMesh sphere_surface(double radius, int level) {
  const double g = std::numbers::phi;
  TriangleMesh mesh{
      {{-1, g, 0},
       {1, g, 0},
       {-1, -g, 0},
       {1, -g, 0},
       {0, -1, g},
       {0, 1, g},
       {0, -1, -g},
       {0, 1, -g},
       {g, 0, -1},
       {g, 0, 1},
       {-g, 0, -1},
       {-g, 0, 1}},
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vec3& v : mesh.vertices) v *= radius / v.norm();
  for (int k = 0; k < level; ++k) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const auto [entry, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(mesh.vertices.size()));
      if (is_new) {
        const Vec3 sum = mesh.vertices[a] + mesh.vertices[b];
        mesh.vertices.push_back(radius / sum.norm() * sum);
      }
      return entry->second;
    };
    std::vector<Face> finer;
    for (const auto& [a, b, c] : mesh.faces) {
      const std::int32_t ab = middle(a, b);
      const std::int32_t bc = middle(b, c);
      const std::int32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.faces = std::move(finer);
  }
  return mesh;
}

TriangleMesh hollow_surface(const TriangleMesh& outer, const TriangleMesh& inner) {
  TriangleMesh both = outer;
  const auto shift = static_cast<std::int32_t>(outer.vertices.size());
  both.vertices.insert(both.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (const auto& [a, b, c] : inner.faces) {
    both.faces.push_back({a + shift, c + shift, b + shift});
  }
  return both;
}

}  // namespace fracbench::bem
