#include "methods/cvd/surface_topology.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "geometry/edge_table.h"

namespace fracbench::cvd {

SurfaceTopology surface_topology(const TriangleMesh& mesh) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = mesh.faces[f];
    if (a == b || b == c || c == a) {
      throw MethodFailure(fmt::format(
          "face {} of the body has corners {}, {}, {}, must have three different ones; repair the "
          "mesh",
          f, a, b, c));
    }
  }
  SurfaceTopology topology;
  topology.mesh = mesh;
  topology.face_edges.resize(mesh.faces.size());
  topology.edges.reserve(3 * mesh.faces.size() / 2);
  EdgeTable(mesh).for_each_edge(
      [&](std::int32_t low, std::int32_t high, std::span<const EdgeTable::Side> sides) {
        if (sides.size() != 2) {
          throw MethodFailure(fmt::format(
              "edge {}-{} of the body has {} face(s), a closed body has 2 at each; repair the mesh",
              low, high, sides.size()));
        }
        if (sides[0].forward == sides[1].forward) {
          throw MethodFailure(fmt::format(
              "the faces at edge {}-{} of the body are turned against each other; repair the mesh",
              low, high));
        }
        for (const EdgeTable::Side& side : sides) {
          topology.face_edges[side.face][side.k] = static_cast<std::int32_t>(topology.edges.size());
        }
        topology.edges.push_back({low, high});
      });
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
