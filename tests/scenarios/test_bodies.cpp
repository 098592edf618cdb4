#include "tests/scenarios/test_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "source_folder.h"

namespace fracbench::test {

namespace {

constexpr double kOnPlane = 1e-12;

Vec3 normal_of(const TriangleMesh& mesh, std::size_t f) {
  return (mesh.corner(f, 1) - mesh.corner(f, 0))
      .cross(mesh.corner(f, 2) - mesh.corner(f, 0))
      .normalized();
}

/// A point just outside of the middle of a face.
Vec3 beside(const TriangleMesh& mesh, std::size_t f) {
  return (mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3 +
         1e-6 * normal_of(mesh, f);
}

bool contains(const TriangleMesh& convex, const Vec3& point) {
  for (std::size_t f = 0; f < convex.faces.size(); ++f) {
    if (normal_of(convex, f).dot(point - convex.corner(f, 0)) > 1e-9) return false;
  }
  return true;
}

}  // namespace

TriangleMesh box(const Vec3& sides, const Vec3& center) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sign((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5);
    mesh.vertices.push_back(center + sign.cwiseProduct(sides));
  }
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh refined(const TriangleMesh& mesh) {
  TriangleMesh fine;
  fine.vertices = mesh.vertices;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(fine.vertices.size()));
    if (is_new) fine.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) / 2);
    return found->second;
  };
  for (const auto& [a, b, c] : mesh.faces) {
    const std::int32_t ab = middle(a, b);
    const std::int32_t bc = middle(b, c);
    const std::int32_t ca = middle(c, a);
    fine.faces.insert(fine.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

TriangleMesh sphere(double radius, int levels) {
  TriangleMesh mesh;
  mesh.vertices = {Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                   -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
  mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) mesh = refined(mesh);
  for (Vec3& vertex : mesh.vertices) vertex = radius * vertex.normalized();
  return mesh;
}

Piece convex_part(const TriangleMesh& convex, const std::vector<PieceFace>& tags,
                  const Vec3& normal, double offset) {
  Piece part;
  TriangleMesh& mesh = part.mesh;
  std::vector<double> height;
  for (const Vec3& vertex : convex.vertices) height.push_back(normal.dot(vertex) - offset);
  std::map<std::int32_t, std::int32_t> kept;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> cut;
  const auto keep = [&](std::int32_t v) {
    const auto [found, is_new] =
        kept.try_emplace(v, static_cast<std::int32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(convex.vertices[v]);
    return found->second;
  };
  const auto cross = [&](std::int32_t a, std::int32_t b) {
    const std::pair<std::int32_t, std::int32_t> key = std::minmax(a, b);
    const auto [found, is_new] =
        cut.try_emplace(key, static_cast<std::int32_t>(mesh.vertices.size()));
    if (is_new) {
      const double t = height[key.first] / (height[key.first] - height[key.second]);
      mesh.vertices.push_back(convex.vertices[key.first] +
                              t * (convex.vertices[key.second] - convex.vertices[key.first]));
    }
    return found->second;
  };
  std::map<std::int32_t, std::int32_t> border;  // edges on the plane, as the cut's face needs them
  for (std::size_t f = 0; f < convex.faces.size(); ++f) {
    std::vector<std::int32_t> polygon;
    std::vector<bool> on_plane;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = convex.faces[f][k];
      const std::int32_t b = convex.faces[f][(k + 1) % 3];
      if (height[a] <= kOnPlane) {
        polygon.push_back(keep(a));
        on_plane.push_back(height[a] >= -kOnPlane);
      }
      if ((height[a] < -kOnPlane && height[b] > kOnPlane) ||
          (height[a] > kOnPlane && height[b] < -kOnPlane)) {
        polygon.push_back(cross(a, b));
        on_plane.push_back(true);
      }
    }
    if (std::ranges::count(on_plane, false) == 0) continue;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const std::size_t next = (k + 1) % polygon.size();
      if (on_plane[k] && on_plane[next]) border[polygon[next]] = polygon[k];
    }
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      mesh.faces.push_back({polygon[0], polygon[k], polygon[k + 1]});
      part.faces.push_back(tags[f]);
    }
  }
  if (border.size() < 3) return part;
  const std::int32_t first = border.begin()->first;
  for (std::int32_t v = border.at(first); border.at(v) != first; v = border.at(v)) {
    mesh.faces.push_back({first, v, border.at(v)});
    part.faces.push_back({});
  }
  return part;
}

std::vector<Piece> PlaneSplitter::fracture(const Impact&, Context&) const {
  std::vector<Piece> pieces(1);
  pieces[0].mesh = mesh_;
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    pieces[0].faces.push_back({.parent_face = static_cast<std::int32_t>(f), .neighbour = -1});
  }
  for (const Cut& cut : cuts_) {
    std::vector<Piece> next;
    for (const Piece& piece : pieces) {
      for (const double side : {1.0, -1.0}) {
        Piece part = convex_part(piece.mesh, piece.faces, side * cut.normal, side * cut.offset);
        if (!part.mesh.empty()) next.push_back(std::move(part));
      }
    }
    pieces = std::move(next);
  }
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    for (std::size_t f = 0; f < pieces[p].faces.size(); ++f) {
      if (!pieces[p].faces[f].is_fracture()) continue;
      const Vec3 beyond = beside(pieces[p].mesh, f);
      for (std::size_t q = 0; q < pieces.size(); ++q) {
        if (q != p && contains(pieces[q].mesh, beyond)) {
          pieces[p].faces[f].neighbour = static_cast<std::int32_t>(q);
        }
      }
    }
    if (!later_.empty()) {
      pieces[p].next = std::make_shared<PlaneSplitter>(pieces[p].mesh, later_);
    }
  }
  return pieces;
}

std::filesystem::path mesh_folder() {
  const std::filesystem::path folder =
      std::filesystem::path(FRACBENCH_SOURCE_DIR) / ".." / "shared" / "meshes";
  return std::filesystem::exists(folder) ? folder : std::filesystem::path{};
}

}  // namespace fracbench::test
