#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// A mesh whose faces belong to groups.
struct GroupedMesh {
  TriangleMesh mesh;
  std::vector<std::int32_t> groups;  ///< parallel to mesh.faces
};

/// A mesh of about `faces` faces to look at, not to measure: edges collapse by quadric error
/// (meshoptimizer), and the lines between groups stay as they are, so that what met there meets
/// still. Faces come group by group, groups in ascending order; vertices that no face uses are
/// left out. A mesh that is small enough is only sorted so.
GroupedMesh simplify(const TriangleMesh& mesh, std::span<const std::int32_t> groups,
                     std::size_t faces);

}  // namespace fracbench
