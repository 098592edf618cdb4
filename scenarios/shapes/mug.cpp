#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/shapes/generated_shapes.h"

namespace fracbench {
namespace {

// m; the handle reaches out about 0.4 beyond the wall.
constexpr double longest_side = 1.5;
constexpr double radius = 0.55;
constexpr double height = 1.3;
constexpr double wall = 0.09;
constexpr double floor_thickness = 0.1;
constexpr double fillet = 0.06;
// Where the handle meets the wall: heights of the middles of its ends, and its size there.
constexpr double upper_end = 0.98;
constexpr double lower_end = 0.36;
constexpr double end_size = 0.2;
// How much narrower the handle is than its ends.
constexpr double taper = 0.75;

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Point i of `count` equally spaced ones around the square [-1, 1]^2, counter-clockwise from
/// (1, -1).
Eigen::Vector2d on_square(int i, int count) {
  const int side = count / 4;
  const double t = -1 + 2.0 * (i % side) / side;
  switch (i / side) {
    case 0:
      return {1, t};
    case 1:
      return {-t, 1};
    case 2:
      return {-1, -t};
    default:
      return {t, -1};
  }
}

/// The wall as a grid of columns and rows with two square patches left out, whose outlines the
/// handle's two ends are sewn to: so the whole is one surface, with regular triangles everywhere.
class Mug {
 public:
  explicit Mug(int resolution) : spacing_(longest_side / resolution) {
    patch_ = std::max(2, 2 * static_cast<int>(std::lround(end_size / (2 * spacing_))));
    columns_ =
        std::max(24, static_cast<int>(std::lround(2 * std::numbers::pi * radius / spacing_)));
    // A patch is as wide as it is high where the wall's columns allow it.
    columns_ = std::max(
        columns_, static_cast<int>(std::lround(2 * std::numbers::pi * radius * patch_ / end_size)));
    add_base();
    add_wall();
    add_inside();
    add_handle();
    drop_unused_vertices();
  }

  TriangleMesh take() { return std::move(rings_.mesh); }

 private:
  using Ring = RingMesh::Ring;

  /// Rings over one piece of the profile, from a ring that is there.
  Ring extend(Ring last, const ProfilePiece& piece, std::int32_t least) {
    const std::vector<ProfilePoint> points = sample(piece, spacing_);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const bool axis = points[i].x() == 0;
      const Ring ring = rings_.add_ring(
          points[i], axis ? 1 : ring_segments(points[i].x(), spacing_, least), !last.half_turned);
      rings_.add_band(last, ring);
      last = ring;
    }
    return last;
  }

  void add_base() {
    const ProfilePoint corner(radius - fillet, 0), end(radius, fillet);
    const Ring middle = rings_.add_ring({0, 0}, 1, false);
    const Ring bottom = extend(middle, line_piece({0, 0}, corner), 6);
    const std::vector<ProfilePoint> points =
        sample(curve_piece(corner, {fillet / 2, 0}, {0, fillet / 2}, end), spacing_);
    Ring last = bottom;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Ring ring = rings_.add_ring(points[i], columns_, false);
      rings_.add_band(last, ring);
      last = ring;
    }
    wall_.push_back(last);
  }

  void add_wall() {
    const double half = end_size / 2;
    const std::array<double, 6> heights{fillet,           lower_end - half, lower_end + half,
                                        upper_end - half, upper_end + half, height - wall / 2};
    for (std::size_t piece = 0; piece + 1 < heights.size(); ++piece) {
      const double length = heights[piece + 1] - heights[piece];
      const bool patch = piece == 1 || piece == 3;
      const int rows =
          patch ? patch_ : std::max(1, static_cast<int>(std::lround(length / spacing_)));
      if (patch) patch_row_.push_back(wall_.size() - 1);
      for (int row = 1; row <= rows; ++row) {
        wall_.push_back(
            rings_.add_ring({radius, heights[piece] + length * row / rows}, columns_, false));
        add_row(patch);
      }
    }
  }

  /// The quadrilaterals below the newest ring of the wall.
  void add_row(bool patch) {
    const int row = static_cast<int>(wall_.size()) - 2;
    for (int column = -patch_ / 2; column < columns_ - patch_ / 2; ++column) {
      if (patch && column < patch_ / 2) continue;
      const std::int32_t a = at(column, row), b = at(column + 1, row), c = at(column + 1, row + 1),
                         d = at(column, row + 1);
      if ((column + row) % 2 == 0) {
        add_quad(a, b, c, d);
      } else {
        add_quad(b, c, d, a);
      }
    }
  }

  void add_quad(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    rings_.mesh.faces.push_back({a, b, c});
    rings_.mesh.faces.push_back({a, c, d});
  }

  std::int32_t at(int column, int row) const {
    return wall_[row].first + (column + columns_) % columns_;
  }

  void add_inside() {
    constexpr double inner = radius - wall, bottom = floor_thickness;
    const ProfilePoint outer_rim(radius, height - wall / 2), top(radius - wall / 2, height),
        inner_rim(inner, height - wall / 2), inner_corner(inner, bottom + fillet),
        floor_edge(inner - fillet, bottom);
    constexpr double arm = 0.55 * wall / 2;
    Ring last = wall_.back();
    last = extend(last, curve_piece(outer_rim, {0, arm}, {-arm, 0}, top), 24);
    last = extend(last, curve_piece(top, {-arm, 0}, {0, -arm}, inner_rim), 24);
    last = extend(last, line_piece(inner_rim, inner_corner), 24);
    last =
        extend(last, curve_piece(inner_corner, {0, -fillet / 2}, {-fillet / 2, 0}, floor_edge), 24);
    extend(last, line_piece(floor_edge, {0, bottom}), 6);
  }

  /// The outline of a patch, counter-clockwise in (u, w) from (+, -), u along the wall's columns
  /// and w along its rows, upwards (`up` = 1) or downwards (-1).
  std::vector<std::int32_t> outline(std::size_t first_row, int up) const {
    const int half = patch_ / 2, middle = static_cast<int>(first_row) + half;
    std::vector<std::int32_t> loop;
    const auto add = [&](int u, int w) { loop.push_back(at(u, middle + up * w)); };
    for (int i = -half; i < half; ++i) add(half, i);
    for (int i = half; i > -half; --i) add(i, half);
    for (int i = half; i > -half; --i) add(-half, i);
    for (int i = -half; i < half; ++i) add(i, -half);
    return loop;
  }

  void add_handle() {
    const std::vector<std::int32_t> upper = outline(patch_row_[1], 1);
    const std::vector<std::int32_t> lower = outline(patch_row_[0], -1);
    // The middle line, in x and z, as if it were a profile.
    const ProfilePiece line =
        curve_piece({radius, upper_end}, {0.56, 0.06}, {-0.56, 0.04}, {radius, lower_end});
    const std::vector<ProfilePoint> points = sample(line, spacing_);
    const auto count = static_cast<int>(upper.size());
    double length = 0;
    for (std::size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
    double from_start = 0;
    std::vector<std::int32_t> last = upper;
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
      from_start += (points[k] - points[k - 1]).norm();
      const double roundness = smooth_step(std::min(from_start, length - from_start) / end_size);
      const ProfilePoint along = (points[k + 1] - points[k - 1]).normalized();
      const Vec3 outer(-along.y(), 0, along.x());
      std::vector<std::int32_t> ring;
      for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * (i - count / 8.0) / count;
        const Eigen::Vector2d round = taper * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        const Eigen::Vector2d place = (1 - roundness) * on_square(i, count) + roundness * round;
        ring.push_back(static_cast<std::int32_t>(rings_.mesh.vertices.size()));
        rings_.mesh.vertices.push_back(Vec3(points[k].x(), 0, points[k].y()) +
                                       end_size / 2 *
                                           (place.x() * Vec3::UnitY() + place.y() * outer));
      }
      sew(last, ring);
      last = ring;
    }
    sew(last, lower);
  }

  void sew(const std::vector<std::int32_t>& from, const std::vector<std::int32_t>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      const std::size_t next = (i + 1) % from.size();
      if (i % 2 == 0) {
        add_quad(from[i], from[next], to[next], to[i]);
      } else {
        add_quad(from[next], to[next], to[i], from[i]);
      }
    }
  }

  /// Those within the patches.
  void drop_unused_vertices() {
    TriangleMesh& mesh = rings_.mesh;
    std::vector<std::int32_t> target(mesh.vertices.size(), -1);
    for (const Face& face : mesh.faces) {
      for (const std::int32_t v : face) target[v] = 0;
    }
    std::int32_t kept = 0;
    for (std::size_t v = 0; v < target.size(); ++v) {
      if (target[v] < 0) continue;
      mesh.vertices[kept] = mesh.vertices[v];
      target[v] = kept++;
    }
    mesh.vertices.resize(kept);
    for (Face& face : mesh.faces) {
      for (std::int32_t& v : face) v = target[v];
    }
  }

  double spacing_;
  int patch_ = 2;     ///< columns and rows of a patch
  int columns_ = 24;  ///< of the wall
  RingMesh rings_;
  std::vector<Ring> wall_;              ///< rows, from below
  std::vector<std::size_t> patch_row_;  ///< index into wall_ of the lower edge of each patch
};

}  // namespace

TriangleMesh mug_mesh(int resolution) { return Mug(resolution).take(); }

}  // namespace fracbench
