#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "scenarios/shapes/generated_shapes.h"

namespace fracbench {
namespace {

/// The regular icosahedron on the unit sphere, outward oriented.
TriangleMesh icosahedron() {
  const double g = std::numbers::phi;
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double s : {-1.0, 1.0}) {
      for (const double l : {-g, g}) {
        Vec3 v = Vec3::Zero();
        v[axis] = s;
        v[(axis + 1) % 3] = l;
        mesh.vertices.push_back(v);
      }
    }
  }
  // Its faces are the triples at the shortest distance, 2, from each other.
  const auto near = [&](int i, int j) {
    return (mesh.vertices[i] - mesh.vertices[j]).norm() < 2.1;
  };
  for (int i = 0; i < 12; ++i) {
    for (int j = i + 1; j < 12; ++j) {
      for (int k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        const bool outward = (b - a).cross(c - a).dot(a) > 0;
        mesh.faces.push_back(outward ? Face{i, j, k} : Face{i, k, j});
      }
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh sphere_mesh(int resolution) {
  // Edges of the icosahedron are 1.0515 radii long; each is cut in n.
  const int n = std::max(1, static_cast<int>(std::lround(1.0515 / 2 * resolution)));
  const TriangleMesh coarse = icosahedron();
  TriangleMesh mesh;
  // A new vertex by its weights for the twelve corners, of which at most three are not 0.
  std::map<std::array<std::array<int, 2>, 3>, std::int32_t> ids;
  const auto vertex = [&](const Face& face, const std::array<int, 3>& weight) {
    std::array<std::array<int, 2>, 3> key;
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      key[k] = weight[k] > 0 ? std::array{face[k], weight[k]} : std::array{-1, 0};
    }
    std::sort(key.begin(), key.end());
    for (const auto& [corner, times] : key) {
      if (corner >= 0) sum += times * coarse.vertices[corner];
    }
    const auto [known, added] =
        ids.try_emplace(key, static_cast<std::int32_t>(mesh.vertices.size()));
    if (added) mesh.vertices.push_back(sum.normalized());
    return known->second;
  };
  for (const Face& face : coarse.faces) {
    const auto at = [&](int i, int j) { return vertex(face, {n - i - j, i, j}); };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        mesh.faces.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < n) mesh.faces.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return mesh;
}

}  // namespace fracbench
