#include "methods/modes/tetrahedralise.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>

#include "core/error.h"
#include "geometry/surface_distance.h"
#include "methods/modes/tetgen_process.h"

namespace fracbench::modes {
namespace {

// What TetGen ends with: see terminatetetgen in tetgen.h.
std::string reason_of(int code) {
  switch (code) {
    case 1:
      return "it ran out of memory; ask for fewer cage faces or tets";
    case 2:
      return "an internal error of TetGen; another number of cage faces usually avoids it";
    case 3:
      return "the surface intersects itself; repair it, or use an offset cage (cage = offset)";
    case 4:
      return "the surface has a feature too small for double precision; remesh it, or use an "
             "offset "
             "cage (cage = offset)";
    case 5:
      return "two of its faces are too close to each other; remesh it, or use an offset cage (cage "
             "= offset)";
    case 10:
      return "TetGen cannot read the surface; check that it is a solid";
    case -1:
      return "TetGen crashed; another number of cage faces usually avoids it";
    default:
      return fmt::format("TetGen's error {}", code);
  }
}

/// What TetGen printed, in one line; empty where that was nothing.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  constexpr std::size_t most = 400;
  if (text.size() > most) text = "..." + text.substr(text.size() - most);
  return text.empty() ? "" : " (TetGen: " + text + ")";
}

/// Which of TetGen's regions are inside: a cavity's is not. One tet tells for its region, the one
/// with the largest volume, whose centroid is far from rounding.
std::map<double, bool> regions_inside(const TriangleMesh& surface, const TetgenOutput& output) {
  const auto corner = [&](std::size_t t, int k) { return output.vertices[output.tets[t][k]]; };
  std::map<double, std::pair<double, std::size_t>> largest;  // by region: volume, tet
  for (std::size_t t = 0; t < output.tets.size(); ++t) {
    const Vec3 a = corner(t, 0);
    const double volume =
        std::abs((corner(t, 1) - a).cross(corner(t, 2) - a).dot(corner(t, 3) - a));
    auto& best = largest.try_emplace(output.regions[t], 0.0, t).first->second;
    if (volume > best.first) best = {volume, t};
  }
  const SurfaceDistance distance(surface);
  std::map<double, bool> inside;
  for (const auto& [region, best] : largest) {
    const std::size_t t = best.second;
    inside[region] =
        distance.inside((corner(t, 0) + corner(t, 1) + corner(t, 2) + corner(t, 3)) / 4);
  }
  return inside;
}

}  // namespace

Tets tetrahedralise(const TriangleMesh& surface, const TetrahedraliseOptions& options,
                    std::string_view name) {
  // p: a surface, A: a number for every region, Q: quiet.
  std::string switches =
      fmt::format("pAQq{:.6f}/{:.6f}", options.radius_edge_ratio, options.minimum_dihedral);
  if (options.largest_volume > 0) switches += fmt::format("a{:.15f}", options.largest_volume);
  const TetgenOutput output = run_tetgen(surface, switches);
  if (output.code != 0) {
    throw MethodFailure(fmt::format("{}: tetrahedralisation failed: {}{}", name,
                                    reason_of(output.code), one_line(output.messages)));
  }
  std::map<double, bool> inside = regions_inside(surface, output);

  Tets result;
  std::vector<std::int32_t> index(output.vertices.size(), -1);
  for (std::size_t t = 0; t < output.tets.size(); ++t) {
    if (!inside[output.regions[t]]) continue;
    Tet tet = output.tets[t];
    for (std::int32_t& v : tet) {
      if (index[v] < 0) {
        index[v] = static_cast<std::int32_t>(result.vertices.size());
        result.vertices.push_back(output.vertices[v]);
      }
      v = index[v];
    }
    result.tets.push_back(tet);
  }
  if (result.tets.empty()) {
    throw MethodFailure(
        fmt::format("{}: tetrahedralisation gave no tets inside the surface; check that it is "
                    "closed and turned outwards",
                    name));
  }
  return result;
}

}  // namespace fracbench::modes
