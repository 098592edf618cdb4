#include "methods/bem/remesh_sheet.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <tuple>

#include "core/error.h"

namespace fracbench::bem {
namespace {

constexpr int kPasses = 6;

Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

}  // namespace

std::vector<SheetEdge> sheet_edges(const TriangleMesh& sheet) {
  std::vector<SheetEdge> all;
  all.reserve(sheet.faces.size() * 3);
  for (std::size_t f = 0; f < sheet.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = sheet.faces[f][k], b = sheet.faces[f][(k + 1) % 3];
      all.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(f), -1, 0});
    }
  }
  std::sort(all.begin(), all.end(), [](const SheetEdge& x, const SheetEdge& y) {
    return std::tie(x.a, x.b, x.left) < std::tie(y.a, y.b, y.left);
  });
  std::vector<SheetEdge> merged;
  merged.reserve(all.size() / 2 + 1);
  for (const SheetEdge& edge : all) {
    if (!merged.empty() && merged.back().a == edge.a && merged.back().b == edge.b) {
      if (merged.back().right >= 0) {
        throw MethodFailure("crack front: three triangles of a sheet share an edge");
      }
      merged.back().right = edge.left;
    } else {
      merged.push_back(edge);
      merged.back().length = (sheet.vertices[edge.a] - sheet.vertices[edge.b]).norm();
    }
  }
  return merged;
}

bool may_collapse(const TriangleMesh& sheet, std::int32_t gone, std::int32_t kept, double size) {
  std::size_t shared = 0;
  const auto at = [&](std::int32_t v) -> const Vec3& { return sheet.vertices[v]; };
  std::vector<std::int32_t> near_gone, near_kept;
  for (const Face& face : sheet.faces) {
    const bool has_gone = std::find(face.begin(), face.end(), gone) != face.end();
    const bool has_kept = std::find(face.begin(), face.end(), kept) != face.end();
    if (has_gone) near_gone.insert(near_gone.end(), face.begin(), face.end());
    if (has_kept) near_kept.insert(near_kept.end(), face.begin(), face.end());
    shared += has_gone && has_kept;
    if (!has_gone || has_kept) continue;
    std::array<Vec3, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = at(face[k] == gone ? kept : face[k]);
    const Vec3 before = normal_of(at(face[0]), at(face[1]), at(face[2]));
    const Vec3 after = normal_of(p[0], p[1], p[2]);
    if (after.norm() < 1e-3 * size * size) return false;
    if (before.dot(after) < 0.5 * before.norm() * after.norm()) return false;
  }
  for (auto* near : {&near_gone, &near_kept}) {
    std::sort(near->begin(), near->end());
    near->erase(std::unique(near->begin(), near->end()), near->end());
  }
  std::vector<std::int32_t> common;
  std::set_intersection(near_gone.begin(), near_gone.end(), near_kept.begin(), near_kept.end(),
                        std::back_inserter(common));
  return common.size() == shared + 2;
}

void collapse_edge(TriangleMesh& sheet, std::int32_t gone, std::int32_t kept) {
  for (Face& face : sheet.faces) std::replace(face.begin(), face.end(), gone, kept);
  std::erase_if(sheet.faces, [](const Face& face) {
    return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
  });
}

void split_long_edges(TriangleMesh& sheet, double longest) {
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<SheetEdge> all = sheet_edges(sheet);
    std::erase_if(all,
                  [&](const SheetEdge& edge) { return edge.right < 0 || edge.length <= longest; });
    if (all.empty()) return;
    std::stable_sort(all.begin(), all.end(),
                     [](const SheetEdge& x, const SheetEdge& y) { return x.length > y.length; });
    std::vector<std::uint8_t> touched(sheet.faces.size(), 0);
    const auto longest_side = [&](std::int32_t f) {
      double length = 0;
      for (int k = 0; k < 3; ++k) {
        length = std::max(length, (sheet.corner(f, k) - sheet.corner(f, (k + 1) % 3)).norm());
      }
      return length * (1 - 1e-12);
    };
    for (const SheetEdge& edge : all) {
      if (touched[edge.left] || touched[edge.right]) continue;
      // The longest side of a triangle first, or ever thinner triangles come of a long boundary
      // edge that cannot be split.
      if (longest_side(edge.left) > edge.length || longest_side(edge.right) > edge.length) continue;
      const auto middle = static_cast<std::int32_t>(sheet.vertices.size());
      sheet.vertices.push_back(0.5 * (sheet.vertices[edge.a] + sheet.vertices[edge.b]));
      for (const std::int32_t f : {edge.left, edge.right}) {
        touched[f] = 1;
        Face half = sheet.faces[f];
        std::replace(half.begin(), half.end(), edge.a, middle);
        std::replace(sheet.faces[f].begin(), sheet.faces[f].end(), edge.b, middle);
        sheet.faces.push_back(half);
      }
    }
  }
}

void collapse_short_edges(TriangleMesh& sheet, const std::vector<std::uint8_t>& on_boundary,
                          double shortest, double size) {
  bool any = true;
  for (int pass = 0; any && pass < kPasses; ++pass) {
    any = false;
    std::vector<std::uint8_t> touched(sheet.vertices.size(), 0);
    for (const SheetEdge& edge : sheet_edges(sheet)) {
      if (edge.right < 0 || edge.length >= shortest) continue;
      if (on_boundary[edge.a] && on_boundary[edge.b]) continue;
      if (touched[edge.a] || touched[edge.b]) continue;
      const std::int32_t gone = on_boundary[edge.a] ? edge.b : edge.a;
      const std::int32_t kept = gone == edge.a ? edge.b : edge.a;
      if (!may_collapse(sheet, gone, kept, size)) continue;
      collapse_edge(sheet, gone, kept);
      touched[gone] = touched[kept] = 1;
      any = true;
    }
  }
}

}  // namespace fracbench::bem
