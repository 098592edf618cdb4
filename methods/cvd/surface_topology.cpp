#include "methods/cvd/surface_topology.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace fracbench::cvd {

SurfaceTopology surface_topology(const TriangleMesh& mesh) {
  struct Side {
    std::array<std::int32_t, 2> ends;
    std::int32_t face;
    std::int8_t corner;
    bool forward;  // the face runs from the lower to the higher index
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int m = 0; m < 3; ++m) {
      const std::int32_t a = mesh.faces[f][m], b = mesh.faces[f][(m + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)},
                       static_cast<std::int32_t>(f),
                       static_cast<std::int8_t>(m),
                       a < b});
    }
  }
  std::ranges::sort(sides, [](const Side& a, const Side& b) {
    return std::tie(a.ends, a.face) < std::tie(b.ends, b.face);
  });

  SurfaceTopology topology;
  topology.mesh = mesh;
  topology.face_edges.resize(mesh.faces.size());
  topology.edges.reserve(sides.size() / 2);
  for (std::size_t s = 0; s < sides.size();) {
    std::size_t end = s;
    while (end < sides.size() && sides[end].ends == sides[s].ends) ++end;
    const auto [a, b] = sides[s].ends;
    if (end - s != 2) {
      throw MethodFailure(fmt::format(
          "edge {}-{} of the body has {} face(s), a closed body has 2 at each; repair the mesh", a,
          b, end - s));
    }
    if (a == b || sides[s].forward == sides[s + 1].forward) {
      throw MethodFailure(fmt::format(
          "the faces at edge {}-{} of the body are turned against each other; repair the mesh", a,
          b));
    }
    for (; s < end; ++s) {
      topology.face_edges[sides[s].face][sides[s].corner] =
          static_cast<std::int32_t>(topology.edges.size());
    }
    topology.edges.push_back({a, b});
  }
  topology.box = bounding_box(mesh);
  topology.volume = volume(mesh);
  topology.scale = std::max({topology.box.longest_side(), topology.box.low.cwiseAbs().maxCoeff(),
                             topology.box.high.cwiseAbs().maxCoeff()});
  if (!(topology.volume > 0)) {
    throw MethodFailure(fmt::format("the body's volume is {} m^3, must be positive; turn its faces",
                                    topology.volume));
  }
  return topology;
}

}  // namespace fracbench::cvd
