#include "geometry/triangle_tree.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace fracbench {
namespace {

// Height over longest edge below which a triangle counts as a needle.
constexpr double needle = 1e-7;
// Boxes are enlarged by this much of the mesh's half size, and squared distances to them taken this
// much smaller: more than all rounding to single precision adds up to.
constexpr float box_margin = 3e-6f;
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

struct TurnedBox {
  Mat3 axes = Mat3::Identity();  ///< rows
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec3& point) {
    const Vec3 p = axes * point;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double half_area() const {
    const Vec3 side = high - low;
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
  }
};

/// Along the triangle's longest edge, across it, and along its normal.
Mat3 triangle_axes(const Vec3& a, const Vec3& b, const Vec3& c) {
  std::array<Vec3, 3> edges{b - a, c - b, a - c};
  const Vec3 longest = *std::max_element(
      edges.begin(), edges.end(),
      [](const Vec3& l, const Vec3& r) { return l.squaredNorm() < r.squaredNorm(); });
  const Vec3 normal = edges[0].cross(edges[1]);
  if (!(normal.norm() > needle * longest.squaredNorm())) return Mat3::Identity();
  Mat3 axes;
  axes.row(0) = longest.normalized();
  axes.row(2) = normal.normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  return axes;
}

/// The principal axes of the points.
Mat3 principal_axes(std::span<const Vec3> points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : points) covariance += (p - mean) * (p - mean).transpose();
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(covariance);
  // Orthonormal beyond doubt, whatever the eigenvalues.
  Mat3 axes;
  axes.row(2) = solver.eigenvectors().col(0).normalized();
  axes.row(0) = solver.eigenvectors().col(2).normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  const double error = (axes * axes.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff();
  return error < 1e-9 ? axes : Mat3::Identity();
}

/// Splits the faces by the surface area heuristic over 16 bins, which is also good for distances.
struct TriangleTree::Builder {
  struct Item {
    Box box;
    std::int32_t face;

    Eigen::Array3f centroid2() const { return box.low + box.high; }
  };
  std::vector<Item> items;    ///< the faces, in the order of the tree
  std::vector<Vec3> corners;  ///< three of each face, in the frame of the boxes
  std::vector<Vec3> points;   ///< corners of the part at hand
  std::vector<Node>& nodes;
  std::vector<TurnedBoxes>& turned;

  struct Part {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };

  Box box_of(const Part& part) const {
    Box box;
    for (std::size_t i = part.begin; i < part.end; ++i) box.add(items[i].box);
    return box;
  }

  /// Large parts of a surface are not flat: a box that is turned to fit them gains nothing.
  static constexpr std::size_t kMostFitted = 16;

  TurnedBox turned_box_of(const Part& part, const Box& upright_box) {
    if (part.size() > kMostFitted) {
      return {.low = upright_box.low.matrix().cast<double>(),
              .high = upright_box.high.matrix().cast<double>()};
    }
    points.clear();
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const auto first = corners.begin() + 3 * static_cast<std::ptrdiff_t>(items[i].face);
      points.insert(points.end(), first, first + 3);
    }
    TurnedBox upright, fitted;
    fitted.axes =
        part.size() == 1 ? triangle_axes(points[0], points[1], points[2]) : principal_axes(points);
    for (const Vec3& p : points) {
      upright.add(p);
      fitted.add(p);
    }
    return fitted.half_area() < upright.half_area() ? fitted : upright;
  }

  /// Orders the part so that it falls in two at the returned place.
  std::size_t split(const Part& part) {
    Box extent;  // of the doubled centroids
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const Eigen::Array3f c = items[i].centroid2();
      extent.add({c, c});
    }
    int axis = 0;
    const float length = (extent.high - extent.low).maxCoeff(&axis);
    const auto begin = items.begin() + part.begin, end = items.begin() + part.end;
    if (length > 0) {
      constexpr int bins = 16;
      const auto bin_of = [&](const Item& item) {
        const float place = (item.centroid2()[axis] - extent.low[axis]) / length;
        return std::min(bins - 1, static_cast<int>(place * bins));
      };
      std::array<Box, bins> bin_box;
      std::array<std::size_t, bins> bin_count{};
      for (auto it = begin; it != end; ++it) {
        const int bin = bin_of(*it);
        bin_box[bin].add(it->box);
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
        const auto middle =
            std::partition(begin, end, [&](const Item& item) { return bin_of(item) < best_bin; });
        return static_cast<std::size_t>(middle - items.begin());
      }
    }
    const std::size_t middle = part.begin + part.size() / 2;
    std::nth_element(begin, items.begin() + middle, end, [&](const Item& l, const Item& r) {
      const float cl = l.centroid2()[axis], cr = r.centroid2()[axis];
      return cl != cr ? cl < cr : l.face < r.face;
    });
    return middle;
  }

  /// Four of them, or one for each face where there are not more.
  std::vector<Part> parts_of(const Part& whole) {
    std::vector<Part> parts;
    if (whole.size() <= 4) {
      for (std::size_t i = whole.begin; i < whole.end; ++i) parts.push_back({i, i + 1});
      return parts;
    }
    parts.push_back(whole);
    while (parts.size() < 4) {
      const auto largest =
          std::max_element(parts.begin(), parts.end(),
                           [](const Part& l, const Part& r) { return l.size() < r.size(); });
      const Part part = *largest;
      const std::size_t middle = split(part);
      *largest = {part.begin, middle};
      parts.insert(largest + 1, Part{middle, part.end});
    }
    return parts;
  }

  /// Makes the node of a part and returns its index.
  std::int32_t build(const Part& whole) {
    const std::vector<Part> parts = parts_of(whole);
    const auto index = static_cast<std::int32_t>(nodes.size());
    nodes.emplace_back();
    turned.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      const Box box = k < parts.size() ? box_of(parts[k]) : Box{};
      const TurnedBox fit = k < parts.size() ? turned_box_of(parts[k], box) : TurnedBox{};
      for (int which = 0; which < 3; ++which) {
        for (int axis = 0; axis < 3; ++axis) {
          turned[index].axis[which][axis][k] = static_cast<float>(fit.axes(which, axis));
        }
        turned[index].low[which][k] = static_cast<float>(fit.low[which]) - box_margin;
        turned[index].high[which][k] = static_cast<float>(fit.high[which]) + box_margin;
      }
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

  Builder builder{std::vector<Builder::Item>(count), {}, {}, nodes_, turned_};
  builder.corners.reserve(3 * count);
  for (std::size_t f = 0; f < count; ++f) {
    builder.items[f].face = static_cast<std::int32_t>(f);
    for (int k = 0; k < 3; ++k) {
      builder.corners.push_back((mesh.corner(f, k) - center_) * scale_);
      const Eigen::Array3f p = builder.corners.back().cast<float>().array();
      builder.items[f].box.add({p, p});
    }
  }
  nodes_.reserve(count / 2 + 1);
  turned_.reserve(count / 2 + 1);
  builder.build({0, count});
  triangles_.reserve(count);
  for (const Builder::Item& item : builder.items) triangles_.push_back(prepare(mesh, item.face));
}

namespace {

using Four = TriangleTree::Four;

/// Squared distances from a point to the boxes of the four children.
[[gnu::always_inline]] inline Four squared_distances(const TriangleTree::TurnedBoxes& boxes,
                                                     const Eigen::Vector3f& point) {
  Four squared = Four::Zero();
  for (int which = 0; which < 3; ++which) {
    const auto& axis = boxes.axis[which];
    const Four place = axis[0] * point[0] + axis[1] * point[1] + axis[2] * point[2];
    const Four gap = (boxes.low[which] - place).max(place - boxes.high[which]).max(0.0f);
    squared += gap * gap;
  }
  return squared;
}

/// Bit k is set where values[k] <= bound.
unsigned at_most(const Four& values, float bound) {
#ifdef __SSE__
  return static_cast<unsigned>(
      _mm_movemask_ps(_mm_cmple_ps(_mm_load_ps(values.data()), _mm_set1_ps(bound))));
#else
  unsigned mask = 0;
  for (int k = 0; k < 4; ++k) mask |= static_cast<unsigned>(values[k] <= bound) << k;
  return mask;
#endif
}

/// Moves bit k to bit 8 k, for four bits.
std::uint32_t spread_to_bytes(unsigned bits) { return (bits * 0x00204081u) & 0x01010101u; }

}  // namespace

template <int count>
std::array<TriangleTree::Nearest, count> TriangleTree::nearest(const Group<count>& group) const {
  static_assert(count <= 8);
  std::array<Nearest, count> best;
  if (nodes_.empty()) return best;
  std::array<Eigen::Vector3f, count> point;
  std::array<float, count> bound{};
  const double to_box_units = scale_ * scale_ * (1 + distance_margin);
  const auto try_triangle = [&](std::int32_t index, int lane) {
    const TreeTriangle& triangle = triangles_[index];
    const double squared = squared_distance(triangle, group.queries[lane]);
    Nearest& known = best[lane];
    if (squared < known.squared_distance ||
        (squared == known.squared_distance &&
         (known.triangle < 0 || triangle.face < triangles_[known.triangle].face))) {
      known = {squared, index};
      bound[lane] = static_cast<float>(squared * to_box_units);
    }
  };
  for (int lane = 0; lane < count; ++lane) {
    point[lane] = to_box_frame(group.queries[lane]);
    // A good first bound makes it needless to sort children by distance.
    const std::int32_t start = group.start[lane];
    try_triangle(start >= 0 ? start : likely_nearest(point[lane]), lane);
  }

  struct Entry {
    std::int32_t child;
    unsigned lanes;  ///< bit mask of the queries that have to look into it
  };
  std::array<Entry, stack_size> stack;
  int top = 0;
  stack[top++] = {0, (1u << count) - 1};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (entry.child < 0) {
      for (unsigned lanes = entry.lanes; lanes != 0; lanes &= lanes - 1) {
        try_triangle(~entry.child, std::countr_zero(lanes));
      }
      continue;
    }
    // Byte k gets the lanes that have to look into child k.
    std::uint32_t wanted = 0;
    for (unsigned lanes = entry.lanes; lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes);
      const unsigned mask =
          at_most(squared_distances(turned_[entry.child], point[lane]), bound[lane]);
      wanted |= spread_to_bytes(mask) << lane;
    }
    const Node& node = nodes_[entry.child];
    for (int k = 0; k < 4; ++k, wanted >>= 8) {
      if ((wanted & 0xff) != 0 && node.child[k] != empty) {
        stack[top++] = {node.child[k], wanted & 0xff};
      }
    }
  }
  return best;
}

template std::array<TriangleTree::Nearest, 1> TriangleTree::nearest<1>(const Group<1>&) const;
template std::array<TriangleTree::Nearest, 8> TriangleTree::nearest<8>(const Group<8>&) const;

TriangleTree::Nearest TriangleTree::nearest(const Vec3& query, std::int32_t start) const {
  Group<1> group{.queries = {query}, .start = {start}};
  return nearest(group)[0];
}

std::int32_t TriangleTree::likely_nearest(const Eigen::Vector3f& point) const {
  std::int32_t child = 0;
  while (child >= 0) {
    const Four squared = squared_distances(turned_[child], point);
    int nearest_child = 0;
    for (int k = 1; k < 4; ++k) {
      if (squared[k] < squared[nearest_child]) nearest_child = k;
    }
    child = nodes_[child].child[nearest_child];
  }
  return ~child;
}

}  // namespace fracbench
