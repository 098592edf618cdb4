#include "geometry/partition_by_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "core/error.h"
#include "geometry/edge_table.h"
#include "geometry/partition/arrangement.h"
#include "geometry/partition/assemble_pieces.h"
#include "geometry/partition/crossings.h"
#include "geometry/partition/exact_partition.h"
#include "geometry/partition/interfaces.h"
#include "geometry/partition/label_lattice.h"

namespace fracbench {
namespace {

using namespace partition;

constexpr int most_attempts = 8;

void require_closed(const TriangleMesh& mesh) {
  if (mesh.empty()) throw InputError("the mesh to partition has no faces");
  for (const Vec3& v : mesh.vertices) {
    if (!v.allFinite()) throw InputError("the mesh to partition has a vertex that is not finite");
  }
  const auto count = static_cast<std::int32_t>(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Face& face = mesh.faces[f];
    for (int k = 0; k < 3; ++k) {
      if (face[k] < 0 || face[k] >= count) {
        throw InputError(
            fmt::format("the mesh to partition: face {} refers to vertex {}, but there are {}", f,
                        face[k], count));
      }
      if (face[k] == face[(k + 1) % 3]) {
        throw InputError(
            fmt::format("the mesh to partition: face {} has vertex {} twice", f, face[k]));
      }
    }
  }
  std::size_t bad = 0;
  std::array<std::int32_t, 2> first{};
  EdgeTable(mesh).for_each_edge(
      [&](std::int32_t low, std::int32_t high, std::span<const EdgeTable::Side> sides) {
        if (sides.size() == 2 && sides[0].forward != sides[1].forward) return;
        if (bad++ == 0) first = {low, high};
      });
  if (bad > 0) {
    throw InputError(fmt::format(
        "the mesh to partition is not closed and oriented: {} edges do not have one face on each "
        "side, the first from vertex {} to {}; close the mesh first",
        bad, first[0], first[1]));
  }
}

}  // namespace

Partition partition_by_labels(const TriangleMesh& mesh, const VoxelGrid<std::int32_t>& labels,
                              const PartitionOptions& options) {
  require_closed(mesh);
  const LabelLattice lattice = make_lattice(mesh, labels, options.threads);
  const double voxel = labels.spacing * labels.spacing * labels.spacing;

  const bool exact = options.path == PartitionPath::exact;
  InterfaceOptions how{.smoothing_steps = options.smoothing_steps,
                       .with_void = exact,
                       .salt = 0,
                       .threads = options.threads};
  const auto attempt = [&](const InterfaceMesh& interfaces) {
    if (exact) return exact_partition(mesh, interfaces, lattice, options.threads);
    const Crossings crossings = find_crossings(mesh, interfaces, lattice.region, options.threads);
    const Arrangement arrangement = arrange(mesh, interfaces, crossings, lattice, options.threads);
    return assemble_pieces(arrangement, lattice.labels, options.minimum_voxels * voxel,
                           options.threads);
  };
  for (;; ++how.salt) {
    const bool last = how.salt + 1 == most_attempts;
    try {
      const InterfaceMesh interfaces = extract_interfaces(lattice, how);
      Partition result = attempt(interfaces);
      PartitionReport& report = result.report;
      report.labels_without_piece.insert(report.labels_without_piece.end(),
                                         lattice.labels_outside.begin(),
                                         lattice.labels_outside.end());
      std::sort(report.labels_without_piece.begin(), report.labels_without_piece.end());
      report.filled_voxels = lattice.filled_voxels;
      report.ambiguous_cells = interfaces.ambiguous_cells;
      report.interface_faces = interfaces.mesh.faces.size();
      report.attempts = static_cast<int>(how.salt) + 1;
      return result;
    } catch (const NotGeneric& error) {
      if (last) {
        throw MethodFailure(
            fmt::format("no valid cut in {} attempts: {}", most_attempts, error.what()));
      }
    } catch (const MethodFailure&) {
      if (last) throw;
    }
  }
}

}  // namespace fracbench
