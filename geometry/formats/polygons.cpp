#include "geometry/formats/polygons.h"

#include <fmt/format.h>

#include <limits>
#include <numeric>

#include "geometry/exact_predicates.h"

namespace fracbench::formats {

namespace {

/// Beyond this, the first ear is taken instead of the best.
constexpr std::size_t most_corners_to_compare = 64;

/// Newell's method: twice the area vector.
Vec3 newell_normal(std::span<const Vec3> corners) {
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  }
  return normal;
}

/// The polygon seen along an axis, counter-clockwise.
std::vector<Point2> flattened(std::span<const Vec3> corners) {
  const Vec3 normal = newell_normal(corners);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(x, y);
  std::vector<Point2> points;
  points.reserve(corners.size());
  for (const Vec3& c : corners) points.push_back({c[x], c[y]});
  return points;
}

class EarClipper {
 public:
  explicit EarClipper(std::span<const Vec3> corners)
      : corners_(corners), points_(flattened(corners)), ring_(corners.size()) {
    std::iota(ring_.begin(), ring_.end(), 0);
  }

  std::vector<Face> run() {
    std::vector<Face> faces;
    faces.reserve(ring_.size() - 2);
    // Where an ear was cut, the next one is often near: the search goes on from there.
    std::size_t start = 0;
    for (std::size_t i = 0; i < ring_.size(); ++i) turns_.push_back(turn(i));
    while (ring_.size() > 3) {
      // Only corners where the polygon does not turn left can be in the way of an ear.
      reflex_.clear();
      for (std::size_t i = 0; i < ring_.size(); ++i) {
        if (turns_[i] <= 0) reflex_.push_back(ring_[i]);
      }
      const std::size_t i = choose(start);
      faces.push_back({before(i), ring_[i], after(i)});
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(i));
      turns_.erase(turns_.begin() + static_cast<std::ptrdiff_t>(i));
      start = i % ring_.size();
      const std::size_t previous = (start + ring_.size() - 1) % ring_.size();
      turns_[start] = turn(start);
      turns_[previous] = turn(previous);
    }
    faces.push_back({ring_[0], ring_[1], ring_[2]});
    return faces;
  }

 private:
  std::int32_t before(std::size_t i) const { return ring_[(i + ring_.size() - 1) % ring_.size()]; }
  std::int32_t after(std::size_t i) const { return ring_[(i + 1) % ring_.size()]; }
  int turn(std::size_t i) const {
    return orientation(points_[before(i)], points_[ring_[i]], points_[after(i)]);
  }

  bool is_ear(std::size_t i) const {
    if (turns_[i] <= 0) return false;
    const Point2 &a = points_[before(i)], &b = points_[ring_[i]], &c = points_[after(i)];
    for (const std::int32_t other : reflex_) {
      const Point2& p = points_[other];
      if (p == a || p == b || p == c) continue;
      if (orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0) {
        return false;
      }
    }
    return true;
  }

  std::size_t choose(std::size_t start) const {
    const std::size_t n = ring_.size();
    std::size_t best = n;
    double best_length = std::numeric_limits<double>::infinity();
    for (std::size_t step = 0; step < n; ++step) {
      const std::size_t i = (start + step) % n;
      if (!is_ear(i)) continue;
      if (n > most_corners_to_compare) return i;
      const double length = (corners_[before(i)] - corners_[after(i)]).squaredNorm();
      if (length < best_length || best == n) {
        best = i;
        best_length = length;
      }
    }
    if (best < n) return best;
    // Not a simple polygon: cut where it at least turns left.
    for (std::size_t i = 0; i < n; ++i) {
      if (turns_[i] > 0) return i;
    }
    return 0;
  }

  std::span<const Vec3> corners_;
  std::vector<Point2> points_;
  std::vector<std::int32_t> ring_, reflex_;
  std::vector<int> turns_;
};

}  // namespace

std::vector<Face> triangulated_polygon(std::span<const Vec3> corners) {
  if (corners.size() < 3) return {};
  if (corners.size() == 3) return {{0, 1, 2}};
  return EarClipper(corners).run();
}

TriangleMesh triangulated(Polygons polygons, const Source& source) {
  TriangleMesh mesh;
  const std::size_t triangles =
      polygons.corners.size() - std::min(polygons.corners.size(), 2 * polygons.ends.size());
  mesh.faces.reserve(triangles);
  std::vector<Vec3> positions;
  std::size_t begin = 0;
  for (std::size_t f = 0; f < polygons.ends.size(); ++f) {
    const std::int32_t* corner = polygons.corners.data() + begin;
    const std::size_t count = polygons.ends[f] - begin;
    begin = polygons.ends[f];
    if (count == 3) {
      mesh.faces.push_back({corner[0], corner[1], corner[2]});
      continue;
    }
    if (count < 3 || count > most_corners) {
      source.fail(fmt::format("face {} (counted from 1)", f + 1),
                  fmt::format("it has {} corners, but a face has 3 to {}", count, most_corners));
    }
    positions.clear();
    for (std::size_t k = 0; k < count; ++k) positions.push_back(polygons.vertices[corner[k]]);
    for (const Face& t : triangulated_polygon(positions)) {
      mesh.faces.push_back({corner[t[0]], corner[t[1]], corner[t[2]]});
    }
  }
  mesh.vertices = std::move(polygons.vertices);
  return mesh;
}

}  // namespace fracbench::formats
