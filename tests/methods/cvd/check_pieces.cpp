#include "tests/methods/cvd/check_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/digest.h"
#include "core/sum.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"

namespace fracbench::test {

namespace {

using Point = std::array<double, 3>;

Point bits(const Vec3& v) { return {v[0], v[1], v[2]}; }

// The corners of a triangle, the least one first, so that equal triangles compare equal.
std::array<Point, 3> corners(const TriangleMesh& mesh, const Face& face, bool turned) {
  std::array<Point, 3> points{bits(mesh.vertices[face[0]]),
                              bits(mesh.vertices[face[turned ? 2 : 1]]),
                              bits(mesh.vertices[face[turned ? 1 : 2]])};
  std::ranges::rotate(points, std::ranges::min_element(points));
  return points;
}

void expect_surface_kept(const TriangleMesh& body, const std::vector<Piece>& pieces) {
  std::vector<Sum> area_of(body.faces.size());
  std::set<Point> kept;
  double farthest = 0;
  for (const Piece& piece : pieces) {
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
      if (piece.faces[f].is_fracture()) continue;
      const std::int32_t parent = piece.faces[f].parent_face;
      ASSERT_LT(parent, static_cast<std::int32_t>(body.faces.size()));
      const Vec3 normal = area_vector2(body, parent);
      area_of[parent] += area_vector2(piece.mesh, f).dot(normal.normalized()) / 2;
      for (int c = 0; c < 3; ++c) {
        const Vec3& v = piece.mesh.corner(f, c);
        kept.insert(bits(v));
        farthest =
            std::max(farthest, std::abs((v - body.corner(parent, 0)).dot(normal.normalized())));
      }
    }
  }
  double worst = 0;
  Sum total;
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    worst = std::max(worst, std::abs(area_of[f].value() - area_vector2(body, f).norm() / 2));
    total += area_of[f].value();
    for (int c = 0; c < 3; ++c) {
      ASSERT_TRUE(kept.contains(bits(body.corner(f, c)))) << "a corner of face " << f << " is lost";
    }
  }
  EXPECT_LT(worst, 1e-13);
  EXPECT_NEAR(total.value() / area(body), 1, 1e-12);
  EXPECT_LT(farthest, 1e-14 * bounding_box(body).longest_side());
}

void expect_interfaces_mutual(const std::vector<Piece>& pieces) {
  std::map<std::array<std::int32_t, 2>, std::vector<std::array<Point, 3>>> sides;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    for (std::size_t f = 0; f < pieces[p].faces.size(); ++f) {
      const PieceFace& face = pieces[p].faces[f];
      if (!face.is_fracture()) continue;
      const auto self = static_cast<std::int32_t>(p);
      ASSERT_GE(face.neighbour, 0);
      ASSERT_LT(face.neighbour, static_cast<std::int32_t>(pieces.size()));
      ASSERT_NE(face.neighbour, self);
      sides[{self, face.neighbour}].push_back(
          corners(pieces[p].mesh, pieces[p].mesh.faces[f], self > face.neighbour));
    }
  }
  for (auto& [pair, triangles] : sides) {
    auto& others = sides[{pair[1], pair[0]}];
    std::ranges::sort(triangles);
    std::ranges::sort(others);
    EXPECT_TRUE(triangles == others) << "pieces " << pair[0] << " and " << pair[1];
  }
}

}  // namespace

std::size_t count_topology_errors(const TriangleMesh& mesh) {
  std::size_t errors = 0;
  std::map<std::array<std::int32_t, 2>, std::int32_t> next;  // directed edge -> opposite corner
  std::map<std::int32_t, std::size_t> faces_at;
  for (const Face& face : mesh.faces) {
    for (int c = 0; c < 3; ++c) {
      errors += !next.emplace(std::array{face[c], face[(c + 1) % 3]}, face[(c + 2) % 3]).second;
      ++faces_at[face[c]];
    }
  }
  std::map<std::int32_t, std::int32_t> first;
  for (const auto& [edge, corner] : next) {
    errors += !next.contains({edge[1], edge[0]});
    first.emplace(edge[0], edge[1]);
  }
  if (errors > 0) return errors;
  for (const auto& [vertex, start] : first) {
    std::size_t size = 0;
    std::int32_t around = start;
    do {
      around = next.at({vertex, around});
      ++size;
    } while (around != start && size <= faces_at[vertex]);
    errors += size != faces_at[vertex];
  }
  return errors + (mesh.vertices.size() != first.size());
}

void expect_filled(const TriangleMesh& body, const std::vector<Piece>& pieces) {
  Sum total;
  for (const Piece& piece : pieces) {
    ASSERT_EQ(piece.faces.size(), piece.mesh.faces.size());
    EXPECT_EQ(count_topology_errors(piece.mesh), 0u);
    EXPECT_GT(volume(piece.mesh), 0);
    total += volume(piece.mesh);
  }
  EXPECT_NEAR(total.value() / volume(body), 1, 1e-14);
  expect_surface_kept(body, pieces);
  expect_interfaces_mutual(pieces);
}

void expect_partition(const TriangleMesh& body, const std::vector<Piece>& pieces) {
  expect_filled(body, pieces);
  for (const Piece& piece : pieces) EXPECT_EQ(piece.next, nullptr);
  EXPECT_EQ(count_crossings(pieces), 0u);
}

std::size_t count_crossings(const std::vector<Piece>& pieces) {
  TriangleMesh complex;
  std::map<Point, std::int32_t> number;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    for (std::size_t f = 0; f < pieces[p].faces.size(); ++f) {
      const PieceFace& face = pieces[p].faces[f];
      if (face.is_fracture() && face.neighbour < static_cast<std::int32_t>(p)) continue;
      Face corners{};
      for (int c = 0; c < 3; ++c) {
        const Vec3& v = pieces[p].mesh.corner(f, c);
        const auto [entry, fresh] =
            number.try_emplace(bits(v), static_cast<std::int32_t>(complex.vertices.size()));
        if (fresh) complex.vertices.push_back(v);
        corners[c] = entry->second;
      }
      complex.faces.push_back(corners);
    }
  }
  return self_intersections(complex).size();
}

std::string digest(const std::vector<Piece>& pieces) {
  Digest digest;
  for (const Piece& piece : pieces) {
    digest.add(piece.mesh);
    digest.add(std::as_bytes(std::span(piece.faces)));
  }
  return digest.hex();
}

std::vector<double> sorted_volumes(const std::vector<Piece>& pieces) {
  std::vector<double> volumes;
  for (const Piece& piece : pieces) volumes.push_back(volume(piece.mesh));
  std::ranges::sort(volumes);
  return volumes;
}

}  // namespace fracbench::test
