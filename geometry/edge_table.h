#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// The undirected edges of a mesh and the faces at each. All indices must be in range; the "edge"
/// from a vertex to itself (in a face with a repeated vertex) is left out.
class EdgeTable {
 public:
  /// A side of a face: from corner k to corner k + 1 of `face`.
  struct Side {
    std::int32_t high = 0;  ///< the larger of the edge's two vertices
    std::int32_t face = 0;
    std::int8_t k = 0;
    bool forward = false;  ///< the face runs from the smaller vertex to the larger
  };

  explicit EdgeTable(const TriangleMesh& mesh);

  /// Calls visit(low, high, sides) for every edge, in ascending order of (low, high); `sides` are
  /// the face sides on it in ascending order of (face, k).
  template <typename Visit>
  void for_each_edge(const Visit& visit) const {
    for (std::size_t low = 0; low + 1 < begin_.size(); ++low) {
      for (std::size_t i = begin_[low]; i < begin_[low + 1];) {
        std::size_t end = i + 1;
        while (end < begin_[low + 1] && sides_[end].high == sides_[i].high) ++end;
        visit(static_cast<std::int32_t>(low), sides_[i].high,
              std::span<const Side>(sides_.data() + i, end - i));
        i = end;
      }
    }
  }

 private:
  std::vector<std::size_t> begin_;  ///< per smaller vertex, into sides_
  std::vector<Side> sides_;
};

}  // namespace fracbench
