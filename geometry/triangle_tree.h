#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// A triangle prepared for distance queries.
struct TreeTriangle {
  Vec3 a, ab, ac;           ///< first corner, and the edges from it to the two others
  Vec3 normal;              ///< unit; zero for a needle, whose normal would be noise
  double abab, abac, acac;  ///< dot products of the edges
  std::int32_t face;        ///< in the mesh
};

/// Squared distance from `query` to the triangle (regions after Ericson, "Real-Time Collision
/// Detection", 2005, section 5.1.5). Finite for degenerate triangles too.
double squared_distance(const TreeTriangle& triangle, const Vec3& query);

/// The point of the triangle nearest to `query`.
Vec3 closest_point(const TreeTriangle& triangle, const Vec3& query);

/// A bounding volume hierarchy over the faces of a mesh, four children to a node, so that one
/// vector instruction tests all of them. A child has a box along the axes, for lines and rays, and
/// one that is turned to fit, for distances: a slanted patch of a surface is thin, and its upright
/// box is not. Boxes are in single precision, in a frame of their own in which the mesh spans
/// [-1, 1], and a little too large, so that every test on them errs on the side of looking closer;
/// the triangles themselves are in double precision.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh);

  using Four = Eigen::Array<float, 4, 1>;
  struct Node {
    std::array<Four, 3> low, high;      ///< boxes of the children, per axis
    std::array<std::int32_t, 4> child;  ///< >= 0: a node; else empty, or ~(index into triangles())
  };
  /// The turned boxes of the children.
  struct TurnedBoxes {
    std::array<std::array<Four, 3>, 3> axis;  ///< [which][coordinate], orthonormal
    std::array<Four, 3> low, high;            ///< along each of them
  };
  static constexpr std::int32_t empty = std::numeric_limits<std::int32_t>::min();

  std::span<const TreeTriangle> triangles() const { return triangles_; }

  struct Nearest {
    double squared_distance = std::numeric_limits<double>::infinity();
    std::int32_t triangle = -1;  ///< index into triangles()
  };
  /// The nearest triangle; of equally near ones, that of the lowest face. `start`, a triangle that
  /// is likely to be near, or -1, only makes it faster.
  Nearest nearest(const Vec3& query, std::int32_t start = -1) const;

  /// Queries that are close together, and for each a triangle that is likely to be near it, or -1.
  template <int count>
  struct Group {
    std::array<Vec3, count> queries;
    std::array<std::int32_t, count> start;
  };
  /// The answers to all queries of a group, faster than one by one. They do not depend on `start`
  /// nor on the other queries, though their cost does.
  template <int count>
  std::array<Nearest, count> nearest(const Group<count>& group) const;

  /// Single precision coordinates in the frame of the boxes.
  Eigen::Vector3f to_box_frame(const Vec3& point) const {
    return ((point - center_) * scale_).cast<float>();
  }
  Vec3 box_center() const { return center_; }
  double box_scale() const { return scale_; }

  /// Calls leaf(index into triangles()) for every triangle whose box, and all boxes around it,
  /// pass: passes(node) returns the bit mask of children to look into.
  template <typename Passes, typename Leaf>
  void visit(const Passes& passes, const Leaf& leaf) const {
    if (nodes_.empty()) return;
    std::array<std::int32_t, stack_size> stack;
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes_[stack[--top]];
      const unsigned mask = passes(node);
      for (int k = 0; k < 4; ++k) {
        if (!(mask >> k & 1u) || node.child[k] == empty) continue;
        if (node.child[k] >= 0) {
          stack[top++] = node.child[k];
        } else {
          leaf(~node.child[k]);
        }
      }
    }
  }

 private:
  struct Builder;

  /// The triangle that a descent to the nearest box at every level ends at.
  std::int32_t likely_nearest(const Eigen::Vector3f& point) const;

  // The builder never makes a part smaller than an eighth of the whole, so that the depth is below
  // log(2^31) / log(8 / 7) = 161, and each level leaves at most three nodes on the stack.
  static constexpr int stack_size = 512;

  Vec3 center_ = Vec3::Zero();
  double scale_ = 1;
  std::vector<Node> nodes_;
  std::vector<TurnedBoxes> turned_;  ///< parallel to nodes_
  std::vector<TreeTriangle> triangles_;
};

}  // namespace fracbench
