#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "methods/bem/crack_sheet.h"

namespace fracbench::bem {

/// The opening along a line on the sheet that starts at the front and runs backwards.
struct FrontProfile {
  std::vector<double> distances;  ///< m along the line from the front, growing; the first is 0
  std::vector<Vec3> openings;     ///< m, parallel to distances
  double edge_length = 0;         ///< m: mean size of the triangles at the front there
};

/// Follows the cut of a sheet with the plane normal to its front, from boundary vertex to boundary
/// vertex. Holds the sheet's adjacency; `sheet` must outlive it.
class FrontProfiles {
 public:
  explicit FrontProfiles(const CrackSheet& sheet);

  /// The profile behind boundary vertex `index` with the frame there; `opening` is parallel to the
  /// sheet's vertices. Only the point at the front where no triangle lies behind it.
  FrontProfile behind(std::size_t index, const FrontFrame& frame,
                      std::span<const Vec3> opening) const;

 private:
  const CrackSheet* sheet_;
  std::vector<std::vector<std::int32_t>> faces_at_;  ///< faces at each vertex
};

}  // namespace fracbench::bem
