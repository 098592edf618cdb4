#include "methods/bem/refit_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/measures.h"

namespace fracbench::bem {
namespace {

/// Interior vertices nearer than this part of the sheet's mean edge to the new mouth are taken out.
constexpr double kRoom = 0.5;
/// A strip with a triangle that faces away from the sheet, or is flatter than this, is refused.
constexpr double kWorst = 0.02;

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 side = b - a;
  const double length2 = side.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(side) / length2, 0.0, 1.0) : 0;
  return (p - a - t * side).norm();
}

/// Badness of a triangle: 1 for an equilateral one, growing without bounds as it gets flat or turns
/// against `normal`.
double badness(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  const double area2 = (b - a).cross(c - a).dot(normal);
  const double quality = sides > 0 ? 2 * std::sqrt(3.0) * area2 / sides : 0;
  return quality > kWorst ? 1 / (quality * quality) : HUGE_VAL;
}

double mean_edge(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) sum += (mesh.corner(f, k) - mesh.corner(f, (k + 1) % 3)).norm();
  }
  return sum / (3 * static_cast<double>(std::max<std::size_t>(mesh.faces.size(), 1)));
}

using Strip = std::vector<std::array<std::pair<bool, std::size_t>, 3>>;  // (on `upper`, index)

/// Triangles between two chains that run side by side, `lower` with the strip to its right and
/// `upper` with the strip to its left (`normals` belong to `lower`), by dynamic programming for the
/// least sum of badness.
std::optional<Strip> zip(const std::vector<Vec3>& upper, const std::vector<Vec3>& lower,
                         const std::vector<Vec3>& normals) {
  const std::size_t rows = upper.size();
  const std::size_t columns = lower.size();
  struct Cell {
    double cost = HUGE_VAL;
    bool along_upper = false;
  };
  std::vector<Cell> table(rows * columns);
  table[0].cost = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      Cell& cell = table[i * columns + j];
      if (i > 0) {
        const double cost = table[(i - 1) * columns + j].cost +
                            badness(upper[i - 1], upper[i], lower[j], normals[j]);
        if (cost < cell.cost) cell = {cost, true};
      }
      if (j > 0) {
        const double cost =
            table[i * columns + j - 1].cost + badness(upper[i], lower[j], lower[j - 1], normals[j]);
        if (cost < cell.cost) cell = {cost, false};
      }
    }
  }
  if (!(table.back().cost < HUGE_VAL)) return {};
  Strip strip;
  std::size_t i = rows - 1;
  std::size_t j = columns - 1;
  while (i > 0 || j > 0) {
    if (table[i * columns + j].along_upper) {
      strip.push_back({{{true, i - 1}, {true, i}, {false, j}}});
      --i;
    } else {
      strip.push_back({{{true, i}, {false, j}, {false, j - 1}}});
      --j;
    }
  }
  return strip;
}

/// The one loop around the given faces, each edge with the faces to its left; nothing where there
/// are several or they touch in a vertex.
std::optional<std::vector<std::int32_t>> loop_around(const TriangleMesh& mesh,
                                                     const std::vector<char>& dead_face) {
  std::map<std::pair<std::int32_t, std::int32_t>, bool> directed;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (dead_face[f] == 0) continue;
    for (int k = 0; k < 3; ++k) directed[{mesh.faces[f][k], mesh.faces[f][(k + 1) % 3]}] = true;
  }
  std::map<std::int32_t, std::int32_t> next;
  for (const auto& [edge, present] : directed) {
    if (directed.contains({edge.second, edge.first})) continue;
    if (!next.emplace(edge.first, edge.second).second) return {};
  }
  if (next.empty()) return {};
  std::vector<std::int32_t> loop;
  std::int32_t at = next.begin()->first;
  do {
    loop.push_back(at);
    const auto after = next.find(at);
    if (after == next.end()) return {};
    at = after->second;
  } while (at != loop.front() && loop.size() <= next.size());
  if (loop.size() != next.size()) return {};
  return loop;
}

/// The loop around the dead faces without the mouth: from `before` to `after`.
std::optional<std::vector<std::int32_t>> chain_of(const TriangleMesh& mesh,
                                                  const std::vector<char>& dead_face,
                                                  std::int32_t before, std::int32_t after) {
  auto loop = loop_around(mesh, dead_face);
  if (!loop) return {};
  const auto start = std::ranges::find(*loop, after);
  if (start == loop->end()) return {};
  std::ranges::rotate(*loop, start);
  const auto end = std::ranges::find(*loop, before);
  if (end == loop->end()) return {};
  loop->erase(end + 1, loop->end());
  std::ranges::reverse(*loop);
  return loop;
}

/// Sheet with unused vertices dropped.
CrackSheet compacted(const CrackSheet& sheet) {
  CrackSheet result;
  std::vector<std::int32_t> fresh(sheet.mesh.vertices.size(), -1);
  for (const Face& face : sheet.mesh.faces) {
    for (const std::int32_t v : face) fresh[v] = 0;
  }
  for (std::size_t v = 0; v < fresh.size(); ++v) {
    if (fresh[v] < 0) continue;
    fresh[v] = static_cast<std::int32_t>(result.mesh.vertices.size());
    result.mesh.vertices.push_back(sheet.mesh.vertices[v]);
  }
  for (const Face& face : sheet.mesh.faces) {
    result.mesh.faces.push_back({fresh[face[0]], fresh[face[1]], fresh[face[2]]});
  }
  for (const std::int32_t v : sheet.boundary) result.boundary.push_back(fresh[v]);
  result.states = sheet.states;
  return result;
}

}  // namespace

std::vector<MouthRun> mouth_runs(const CrackSheet& sheet) {
  const std::size_t count = sheet.boundary.size();
  const auto at_surface = [&](std::size_t i) {
    return sheet.states[i % count] == FrontState::at_surface;
  };
  std::vector<MouthRun> runs;
  std::size_t start = 0;
  while (start < count && at_surface(start)) ++start;
  if (start == count) return count >= 3 ? std::vector<MouthRun>{{0, count - 1}} : runs;
  for (std::size_t i = start; i < start + count; ++i) {
    if (!at_surface(i) || at_surface(i + count - 1)) continue;
    std::size_t last = i;
    while (at_surface(last + 1)) ++last;
    if (last >= i + 2) runs.push_back({i % count, last % count});
  }
  std::ranges::sort(runs, {}, &MouthRun::first);
  return runs;
}

std::optional<RefitSheet> refit_sheet(const CrackSheet& sheet, const MouthRun& run,
                                      std::span<const Vec3> mouth) {
  const TriangleMesh& mesh = sheet.mesh;
  const std::size_t count = sheet.boundary.size();
  const std::size_t run_length = (run.last + count - run.first) % count + 1;
  const bool closed = run_length == count;
  if (mouth.size() < 3) return {};

  std::vector<char> dead(mesh.vertices.size(), 0);
  std::vector<char> on_boundary(mesh.vertices.size(), 0);
  for (const std::int32_t v : sheet.boundary) on_boundary[v] = 1;
  for (std::size_t i = 0; i < run_length; ++i) dead[sheet.boundary[(run.first + i) % count]] = 1;
  const double room = kRoom * mean_edge(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (on_boundary[v] != 0) continue;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < mouth.size(); ++i) {
      const Vec3& end = mouth[(i + 1) % mouth.size()];
      if (distance_to_segment(mesh.vertices[v], mouth[i], end) < room) dead[v] = 1;
    }
  }
  std::vector<char> dead_face(mesh.faces.size(), 0);
  std::vector<char> live_face(mesh.faces.size(), 0);
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const bool room_made =
        std::ranges::any_of(mesh.faces[f], [&](std::int32_t v) { return dead[v] != 0; });
    (room_made ? dead_face : live_face)[f] = 1;
    for (const std::int32_t v : mesh.faces[f]) normals[v] += area_vector2(mesh, f);
  }
  std::vector<std::int32_t> chain;  // what the strip is sewn to, along the mouth
  if (closed) {
    const auto loop = loop_around(mesh, live_face);
    if (!loop) return {};
    const auto distance = [&](std::int32_t v) { return (mesh.vertices[v] - mouth[0]).norm(); };
    chain = *loop;
    std::ranges::rotate(chain, std::ranges::min_element(chain, {}, distance));
    chain.push_back(chain.front());
  } else {
    const auto found = chain_of(mesh, dead_face, sheet.boundary[(run.first + count - 1) % count],
                                sheet.boundary[(run.last + 1) % count]);
    if (!found) return {};
    chain = *found;
  }
  std::vector<Vec3> upper(mouth.begin(), mouth.end());
  if (closed) upper.push_back(mouth.front());
  std::vector<Vec3> lower;
  std::vector<Vec3> lower_normals;
  for (const std::int32_t v : chain) {
    if (dead[v] != 0 || !(normals[v].norm() > 0)) return {};
    lower.push_back(mesh.vertices[v]);
    lower_normals.push_back(normals[v].normalized());
  }
  const auto strip = zip(upper, lower, lower_normals);
  if (!strip) return {};

  CrackSheet next{.mesh = {.vertices = mesh.vertices, .faces = {}}, .boundary = {}, .states = {}};
  const auto first_new = static_cast<std::int32_t>(mesh.vertices.size());
  next.mesh.vertices.insert(next.mesh.vertices.end(), mouth.begin(), mouth.end());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (dead_face[f] == 0) next.mesh.faces.push_back(mesh.faces[f]);
  }
  for (const auto& triangle : *strip) {
    Face face{};
    for (int k = 0; k < 3; ++k) {
      const auto [on_mouth, index] = triangle[k];
      face[k] =
          on_mouth ? first_new + static_cast<std::int32_t>(index % mouth.size()) : chain[index];
    }
    next.mesh.faces.push_back(face);
  }
  RefitSheet result;
  for (std::size_t i = 0; i < count - run_length; ++i) {
    const std::size_t entry = (run.last + 1 + i) % count;
    next.boundary.push_back(sheet.boundary[entry]);
    next.states.push_back(sheet.states[entry]);
    result.source.push_back(static_cast<std::int32_t>(entry));
  }
  for (std::size_t i = 0; i < mouth.size(); ++i) {
    next.boundary.push_back(first_new + static_cast<std::int32_t>(i));
    next.states.push_back(FrontState::at_surface);
    result.source.push_back(-1);
  }
  result.sheet = compacted(next);
  return result;
}

}  // namespace fracbench::bem
