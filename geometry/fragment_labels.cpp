#include "geometry/fragment_labels.h"

#include "core/parallel.h"
#include "geometry/signed_distance/winding_scan.h"

namespace fracbench {

FragmentSurfaces fragment_surfaces(const Fragments& fragments) {
  FragmentSurfaces all;
  for (std::size_t n = 0; n < fragments.size(); ++n) {
    const TriangleMesh& mesh = fragments[n].mesh;
    const auto first = static_cast<std::int32_t>(all.mesh.vertices.size());
    all.mesh.vertices.insert(all.mesh.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const Face& face : mesh.faces) {
      all.mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
    }
    all.fragment.resize(all.mesh.faces.size(), static_cast<std::int32_t>(n));
  }
  return all;
}

VoxelGrid<std::int32_t> fragment_labels(const Fragments& fragments, VoxelGrid<std::int32_t> grid,
                                        int threads) {
  // Faces that count as often as their fragment's number: the winding number is the label.
  FragmentSurfaces surfaces = fragment_surfaces(fragments);
  for (std::int32_t& weight : surfaces.fragment) ++weight;
  const WindingScan scan(surfaces.mesh, grid, std::move(surfaces.fragment));
  parallel_for(static_cast<std::size_t>(grid.size[2]), threads, [&](std::size_t slice) {
    const int k = static_cast<int>(slice);
    const std::vector<std::int32_t> winding = scan.slice(k);
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::int32_t label = winding[i + scan.row() * j];
        grid.at(i, j, k) = label == 0 ? -1 : label;
      }
    }
  });
  return grid;
}

}  // namespace fracbench
