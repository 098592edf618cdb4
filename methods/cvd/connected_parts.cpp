#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/sum.h"
#include "methods/cvd/pieces.h"
#include "methods/cvd/predicates.h"
#include "methods/cvd/winding.h"

namespace fracbench::cvd {

namespace {

constexpr double kVolumeTolerance = 1e-10;

// Disjoint sets over the pairs (vertex, cell that meets there).
class VertexSets {
 public:
  explicit VertexSets(const CellComplex& complex)
      : complex_(complex), parent_(4 * complex.vertices.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void join(const Face& corners, std::int32_t cell) {
    const std::int32_t a = root(corners[0], cell);
    unite(a, root(corners[1], cell));
    unite(root(corners[0], cell), root(corners[2], cell));
  }

  std::int32_t root(std::int32_t vertex, std::int32_t cell) {
    const auto& cells = complex_.cells_at[vertex];
    const auto at = std::ranges::find(cells, cell) - cells.begin();
    std::int32_t x = static_cast<std::int32_t>(4 * vertex + at);
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }

  std::size_t size() const { return parent_.size(); }

 private:
  void unite(std::int32_t a, std::int32_t b) { parent_[std::max(a, b)] = std::min(a, b); }

  const CellComplex& complex_;
  std::vector<std::int32_t> parent_;
};

// A connected part of a cell's boundary.
struct Shell {
  std::int32_t cell = -1;
  std::int32_t vertex = -1;  // one of its vertices
  Sum volume;
  bool cracked = false;
};

// The solid that a cavity's shell lies in: the smallest of its cell that winds around it.
std::int32_t enclosing_shell(const CellComplex& complex, const CellParts& shell_of,
                             const std::vector<Shell>& shells, const Shell& cavity) {
  std::vector<Sum> winding(shells.size());
  const Vec3& point = complex.vertices[cavity.vertex];
  const auto add = [&](const Face& f, std::int32_t shell, double sign) {
    if (shells[shell].cell != cavity.cell) return;
    winding[shell] += sign * winding_of_triangle(complex.vertices[f[0]], complex.vertices[f[1]],
                                                 complex.vertices[f[2]], point);
  };
  for (std::size_t t = 0; t < complex.surface.size(); ++t) {
    add(complex.surface[t].corners, shell_of.of_surface[t], 1);
  }
  for (std::size_t t = 0; t < complex.cracks.size(); ++t) {
    add(complex.cracks[t].corners, shell_of.of_cracks[t][0], 1);
    add(complex.cracks[t].corners, shell_of.of_cracks[t][1], -1);
  }
  std::int32_t best = -1;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (shells[s].volume.value() <= 0 || !(winding[s].value() > 0.5)) continue;
    if (best < 0 || shells[s].volume.value() < shells[best].volume.value()) {
      best = static_cast<std::int32_t>(s);
    }
  }
  if (best < 0) throw Degenerate("a cavity of the body lies in no piece");
  return best;
}

}  // namespace

CellParts connected_parts(const CellComplex& complex, double body_volume) {
  VertexSets sets(complex);
  for (const SurfaceTriangle& t : complex.surface) sets.join(t.corners, t.cell);
  for (const CrackTriangle& t : complex.cracks) {
    for (const std::int32_t cell : t.cells) sets.join(t.corners, cell);
  }

  CellParts shell_of;
  std::vector<Shell> shells;
  std::vector<std::int32_t> shell_at(sets.size(), -1);
  const Vec3 origin = complex.vertices.empty() ? Vec3::Zero() : complex.vertices.front();
  const auto shell_with = [&](const Face& f, std::int32_t cell, double sign) {
    std::int32_t& shell = shell_at[sets.root(f[0], cell)];
    if (shell < 0) {
      shell = static_cast<std::int32_t>(shells.size());
      shells.push_back({cell, f[0], {}, false});
    }
    const Vec3 a = complex.vertices[f[0]] - origin, b = complex.vertices[f[1]] - origin,
               c = complex.vertices[f[2]] - origin;
    shells[shell].volume += sign * a.dot(b.cross(c)) / 6;
    return shell;
  };
  for (const SurfaceTriangle& t : complex.surface) {
    shell_of.of_surface.push_back(shell_with(t.corners, t.cell, 1));
  }
  for (const CrackTriangle& t : complex.cracks) {
    const std::int32_t front = shell_with(t.corners, t.cells[0], 1);
    const std::int32_t back = shell_with(t.corners, t.cells[1], -1);
    shells[front].cracked = shells[back].cracked = true;
    shell_of.of_cracks.push_back({front, back});
  }

  // A cell is convex, so what a shell turned inwards encloses lies in the cell too: only whole
  // shells of the body's surface, without cracks, can bound a cavity.
  std::vector<std::int32_t> part(shells.size(), -1);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (shells[s].volume.value() > 0) {
      part[s] = static_cast<std::int32_t>(shell_of.volumes.size());
      shell_of.volumes.push_back(shells[s].volume.value());
    } else if (shells[s].cracked) {
      throw Degenerate("a piece has no volume");
    }
  }
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (part[s] >= 0) continue;
    part[s] = part[enclosing_shell(complex, shell_of, shells, shells[s])];
    shell_of.volumes[part[s]] += shells[s].volume.value();
  }
  for (std::int32_t& shell : shell_of.of_surface) shell = part[shell];
  for (auto& [front, back] : shell_of.of_cracks) {
    front = part[front];
    back = part[back];
  }

  Sum total;
  for (const double volume : shell_of.volumes) total += volume;
  if (!(std::abs(total.value() / body_volume - 1) < kVolumeTolerance)) {
    throw Degenerate(
        fmt::format("the pieces have {} of the body's volume", total.value() / body_volume));
  }
  return shell_of;
}

}  // namespace fracbench::cvd
