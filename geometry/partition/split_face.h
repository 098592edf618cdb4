#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec3.h"

namespace fracbench::partition {

/// A triangle and the curves that cut it. Points are numbered as the caller likes.
struct FaceToSplit {
  struct Point {
    std::int32_t number = 0;
    Vec3 position = Vec3::Zero();
  };
  struct Cut {
    std::int32_t from = 0, to = 0;     ///< indices into `points`
    std::int32_t left = 0, right = 0;  ///< what lies on either side, seen along the normal
  };
  std::vector<Point> points;
  std::int32_t rim = 0;  ///< the first so many points are the rim, counter-clockwise
  Vec3 normal = Vec3::Zero();
  std::vector<Cut> cuts;  ///< at least one
};

struct SubFace {
  std::array<std::int32_t, 3> corners;  ///< numbers of the points
  std::int32_t side = 0;                ///< `left` or `right` of the cuts around it
};

/// Triangulates the face so that rim and cuts are edges (constrained Delaunay, in the projection
/// along the longest component of the normal) and says on which side of the cuts each triangle is.
/// Throws NotGeneric where rounding made cuts cross, points coincide or sides contradict.
void split_face(const FaceToSplit& face, std::vector<SubFace>& result);

}  // namespace fracbench::partition
