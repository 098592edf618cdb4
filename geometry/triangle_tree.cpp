#include "geometry/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fracbench {
namespace {

// Height over longest edge below which a triangle counts as a needle.
constexpr double needle = 1e-7;
// Boxes are enlarged by this much of the mesh's half size, and squared distances to them taken this
// much smaller: more than all rounding to single precision adds up to.
constexpr float box_margin = 1e-6f;
constexpr double distance_margin = 1e-5;

TreeTriangle prepare(const TriangleMesh& mesh, std::int32_t face) {
  TreeTriangle t;
  t.a = mesh.corner(face, 0);
  t.ab = mesh.corner(face, 1) - t.a;
  t.ac = mesh.corner(face, 2) - t.a;
  t.abab = t.ab.squaredNorm();
  t.abac = t.ab.dot(t.ac);
  t.acac = t.ac.squaredNorm();
  const Vec3 normal = t.ab.cross(t.ac);
  const double longest2 = std::max({t.abab, t.acac, (t.ac - t.ab).squaredNorm()});
  const double length = normal.norm();
  t.normal = Vec3::Zero();
  if (length > needle * longest2) t.normal = normal / length;
  t.face = face;
  return t;
}

struct Box {
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array3f high = Eigen::Array3f::Constant(-std::numeric_limits<float>::infinity());

  void add(const Box& other) {
    low = low.min(other.low);
    high = high.max(other.high);
  }
  float half_area() const {
    const Eigen::Array3f side = high - low;
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
  }
};

}  // namespace

/// Splits the faces by the surface area heuristic over 16 bins, which is also good for distances.
struct TriangleTree::Builder {
  std::vector<Box> boxes;           ///< of each face
  std::vector<std::int32_t> order;  ///< faces, in the order of the tree
  std::vector<Node>& nodes;

  struct Part {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };

  Box box_of(const Part& part) const {
    Box box;
    for (std::size_t i = part.begin; i < part.end; ++i) box.add(boxes[order[i]]);
    return box;
  }

  Eigen::Array3f centroid2(std::int32_t face) const { return boxes[face].low + boxes[face].high; }

  /// Orders the part so that it falls in two at the returned place.
  std::size_t split(const Part& part) {
    Box extent;  // of the doubled centroids
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const Eigen::Array3f c = centroid2(order[i]);
      extent.add({c, c});
    }
    int axis = 0;
    const float length = (extent.high - extent.low).maxCoeff(&axis);
    const auto begin = order.begin() + part.begin, end = order.begin() + part.end;
    if (length > 0) {
      constexpr int bins = 16;
      const auto bin_of = [&](std::int32_t face) {
        const float place = (centroid2(face)[axis] - extent.low[axis]) / length;
        return std::min(bins - 1, static_cast<int>(place * bins));
      };
      std::array<Box, bins> bin_box;
      std::array<std::size_t, bins> bin_count{};
      for (auto it = begin; it != end; ++it) {
        const int bin = bin_of(*it);
        bin_box[bin].add(boxes[*it]);
        ++bin_count[bin];
      }
      std::array<float, bins> right_cost{};
      Box right;
      std::size_t right_count = 0;
      for (int bin = bins - 1; bin > 0; --bin) {
        right.add(bin_box[bin]);
        right_count += bin_count[bin];
        right_cost[bin] = right_count ? right.half_area() * static_cast<float>(right_count) : 0;
      }
      Box left;
      std::size_t left_count = 0;
      float best_cost = std::numeric_limits<float>::infinity();
      int best_bin = -1;
      for (int bin = 1; bin < bins; ++bin) {
        left.add(bin_box[bin - 1]);
        left_count += bin_count[bin - 1];
        const std::size_t smaller = std::min(left_count, part.size() - left_count);
        if (smaller == 0 || smaller < part.size() / 8) continue;
        const float cost = left.half_area() * static_cast<float>(left_count) + right_cost[bin];
        if (cost < best_cost) {
          best_cost = cost;
          best_bin = bin;
        }
      }
      if (best_bin > 0) {
        const auto middle = std::stable_partition(
            begin, end, [&](std::int32_t face) { return bin_of(face) < best_bin; });
        return static_cast<std::size_t>(middle - order.begin());
      }
    }
    const std::size_t middle = part.begin + part.size() / 2;
    std::nth_element(begin, order.begin() + middle, end, [&](std::int32_t l, std::int32_t r) {
      const float cl = centroid2(l)[axis], cr = centroid2(r)[axis];
      return cl != cr ? cl < cr : l < r;
    });
    return middle;
  }

  /// Makes the node of a part and returns its index.
  std::int32_t build(const Part& whole) {
    std::vector<Part> parts{whole};
    while (parts.size() < 4) {
      const auto largest =
          std::max_element(parts.begin(), parts.end(),
                           [](const Part& l, const Part& r) { return l.size() < r.size(); });
      if (largest->size() < 2) break;
      const Part part = *largest;
      const std::size_t middle = split(part);
      *largest = {part.begin, middle};
      parts.insert(largest + 1, Part{middle, part.end});
    }
    const auto index = static_cast<std::int32_t>(nodes.size());
    nodes.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      const Box box = k < parts.size() ? box_of(parts[k]) : Box{};
      for (int axis = 0; axis < 3; ++axis) {
        nodes[index].low[axis][k] = box.low[axis] - box_margin;
        nodes[index].high[axis][k] = box.high[axis] + box_margin;
      }
      std::int32_t child = empty;
      if (k < parts.size()) {
        child = parts[k].size() == 1 ? ~static_cast<std::int32_t>(parts[k].begin) : build(parts[k]);
      }
      nodes[index].child[k] = child;
    }
    return index;
  }
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  const std::size_t count = mesh.faces.size();
  if (count == 0) return;
  Vec3 low = mesh.corner(0, 0), high = low;
  for (std::size_t f = 0; f < count; ++f) {
    for (int k = 0; k < 3; ++k) {
      low = low.cwiseMin(mesh.corner(f, k));
      high = high.cwiseMax(mesh.corner(f, k));
    }
  }
  center_ = (low + high) / 2;
  const double half = (high - low).maxCoeff() / 2;
  scale_ = half > 0 && std::isfinite(1 / half) ? 1 / half : 1;

  Builder builder{std::vector<Box>(count), std::vector<std::int32_t>(count), nodes_};
  for (std::size_t f = 0; f < count; ++f) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Array3f p = to_box_frame(mesh.corner(f, k)).array();
      builder.boxes[f].add({p, p});
    }
  }
  std::iota(builder.order.begin(), builder.order.end(), 0);
  nodes_.reserve(count / 2 + 1);
  builder.build({0, count});
  triangles_.reserve(count);
  for (const std::int32_t face : builder.order) triangles_.push_back(prepare(mesh, face));
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& query, std::int32_t start) const {
  Nearest best;
  if (nodes_.empty()) return best;
  const double to_box_units = scale_ * scale_ * (1 + distance_margin);
  float bound = std::numeric_limits<float>::infinity();
  const auto try_triangle = [&](std::int32_t index) {
    const TreeTriangle& triangle = triangles_[index];
    const double squared = squared_distance(triangle, query);
    if (squared < best.squared_distance ||
        (squared == best.squared_distance && triangle.face < triangles_[best.triangle].face)) {
      best = {squared, index};
      bound = static_cast<float>(squared * to_box_units);
    }
  };
  if (start >= 0) try_triangle(start);

  const Eigen::Vector3f q = to_box_frame(query);
  struct Entry {
    float squared_distance;
    std::int32_t child;
  };
  std::array<Entry, stack_size> stack;
  int top = 0;
  stack[top++] = {0, 0};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.squared_distance > bound) continue;
    if (entry.child < 0) {
      try_triangle(~entry.child);
      continue;
    }
    const Node& node = nodes_[entry.child];
    Four squared = Four::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      const Four gap = (node.low[axis] - q[axis]).max(q[axis] - node.high[axis]).max(0.0f);
      squared += gap * gap;
    }
    // Farthest first onto the stack, by insertion.
    const int first = top;
    for (int k = 0; k < 4; ++k) {
      if (squared[k] > bound || node.child[k] == empty) continue;
      int place = top++;
      for (; place > first && stack[place - 1].squared_distance < squared[k]; --place) {
        stack[place] = stack[place - 1];
      }
      stack[place] = {squared[k], node.child[k]};
    }
  }
  return best;
}

}  // namespace fracbench
