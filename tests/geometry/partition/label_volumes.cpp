#include "tests/geometry/partition/label_volumes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/sum.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "geometry/overlap.h"

namespace fracbench::test_labels {
namespace {

using Bits = std::array<double, 3>;

Bits bits(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

double area_of(const TriangleMesh& mesh, std::size_t face) {
  return area_vector2(mesh, face).norm() / 2;
}

}  // namespace

Labels grid_around(const TriangleMesh& mesh, int r) {
  const BoundingBox box = bounding_box(mesh);
  const double spacing = box.longest_side() / (r - 2);
  const Vec3 origin = box.center() - Vec3::Constant(spacing * (r - 1) / 2);
  return Labels({r, r, r}, origin, spacing);
}

Labels filled(Labels grid, const std::function<std::int32_t(int, int, int)>& label) {
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) grid.at(i, j, k) = label(i, j, k);
    }
  }
  return grid;
}

Labels voronoi(Labels grid, int count, Random& random) {
  std::vector<Vec3> sites;
  for (int s = 0; s < count; ++s) {
    sites.push_back(grid.position(0, 0, 0) + grid.spacing * Vec3(random.uniform() * grid.size[0],
                                                                 random.uniform() * grid.size[1],
                                                                 random.uniform() * grid.size[2]));
  }
  return filled(grid, [&](int i, int j, int k) {
    std::int32_t best = 0;
    for (std::int32_t s = 1; s < count; ++s) {
      if ((grid.position(i, j, k) - sites[s]).squaredNorm() <
          (grid.position(i, j, k) - sites[best]).squaredNorm()) {
        best = s;
      }
    }
    return best + 1;
  });
}

Labels noise(Labels grid, int count, Random& random) {
  return filled(std::move(grid), [&](int, int, int) {
    return static_cast<std::int32_t>(1 + random.below(static_cast<std::uint64_t>(count)));
  });
}

Labels checkerboard(Labels grid) {
  return filled(std::move(grid), [](int i, int j, int k) { return 1 + (i + j + k) % 2; });
}

Labels slabs(Labels grid, int count) {
  return filled(std::move(grid), [&](int i, int, int) { return 1 + i % count; });
}

Labels single_voxels(Labels grid) {
  const auto size = grid.size;
  return filled(std::move(grid),
                [&](int i, int j, int k) { return 1 + i + size[0] * (j + size[1] * k); });
}

std::string faults(const TriangleMesh& mesh, const Partition& partition,
                   const Expectations& expect) {
  std::string said;
  const auto say = [&](std::string_view what) { said += fmt::format("{}\n", what); };
  const std::vector<Piece>& pieces = partition.pieces;
  if (partition.report.piece_label.size() != pieces.size()) say("not one label per piece");

  Sum total;
  std::vector<double> covered(mesh.faces.size(), 0);
  std::set<Bits> kept;
  std::map<std::pair<std::int32_t, std::int32_t>, double> interface_area;
  std::map<std::pair<std::int32_t, std::int32_t>, std::set<std::set<Bits>>> triangles;
  std::vector<std::reference_wrapper<const TriangleMesh>> solids;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const TriangleMesh& piece = pieces[p].mesh;
    const MeshReport report = check_mesh(piece);
    if (!report.is_solid()) say(fmt::format("piece {}: {}", p, report.describe()));
    if (pieces[p].faces.size() != piece.faces.size()) {
      say(fmt::format("piece {}: not one tag per face", p));
      continue;
    }
    total += report.volume;
    solids.emplace_back(piece);
    for (const Vec3& v : piece.vertices) kept.insert(bits(v));
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
      const PieceFace& tag = pieces[p].faces[f];
      if (!tag.is_fracture()) {
        covered[tag.parent_face] += area_of(piece, f);
        const Vec3 normal = area_vector2(mesh, tag.parent_face).normalized();
        for (int k = 0; k < 3; ++k) {
          const double off = normal.dot(piece.corner(f, k) - mesh.corner(tag.parent_face, 0));
          if (std::abs(off) > 1e-12) say(fmt::format("piece {} face {}: off by {}", p, f, off));
        }
        continue;
      }
      const auto self = static_cast<std::int32_t>(p);
      if (tag.neighbour < 0 || tag.neighbour == self) {
        say(fmt::format("piece {} face {}: neighbour {}", p, f, tag.neighbour));
      }
      interface_area[{self, tag.neighbour}] += area_of(piece, f);
      triangles[{self, tag.neighbour}].insert(
          {bits(piece.corner(f, 0)), bits(piece.corner(f, 1)), bits(piece.corner(f, 2))});
    }
  }
  const double whole = volume(mesh);
  if (std::abs(total.value() / whole - 1) > expect.volume_tolerance) {
    say(fmt::format("the volumes add up to {} of the whole", total.value() / whole));
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const double area = area_of(mesh, f);
    if (std::abs(covered[f] - area) > 1e-9 * area + 1e-15) {
      say(fmt::format("face {} of the mesh is covered {} times", f, covered[f] / area));
    }
    for (int k = 0; k < 3; ++k) {
      if (!kept.contains(bits(mesh.corner(f, k))))
        say(fmt::format("a vertex of face {} is gone", f));
    }
  }
  for (const auto& [pair, area] : interface_area) {
    const std::pair back(pair.second, pair.first);
    const auto other = interface_area.find(back);
    if (other == interface_area.end() || std::abs(other->second - area) > 1e-9 * area + 1e-15) {
      say(fmt::format("the interface from {} to {} has another area than back", pair.first,
                      pair.second));
    }
    if (expect.shared_interfaces && triangles[pair] != triangles[back]) {
      say(fmt::format("pieces {} and {} do not share their triangles", pair.first, pair.second));
    }
  }
  if (expect.disjoint && pieces.size() < 200) {
    for (const Overlap& o : find_overlaps(solids)) {
      say(fmt::format("pieces {} and {} overlap by {} m", o.first, o.second, o.depth));
    }
  }
  return said.substr(0, 2000);
}

}  // namespace fracbench::test_labels
