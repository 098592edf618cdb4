#include "methods/cvd/interior_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace fracbench::cvd {

namespace {

// Roberts' R2 sequence: the powers of the inverse of the plastic number.
constexpr double kPlastic1 = 0.7548776662466927;
constexpr double kPlastic2 = 0.5698402909980532;

// Most columns along one side of the box. A body that fills little of its box (a thin wall) would
// ask for more lines than memory can hold; with fewer, its points lie closer along each line.
constexpr double kMostColumns = 2048;

double fraction(double x) { return x - std::floor(x); }

// Where the lines of a grid cross the surface.
class Lines {
 public:
  // Lines in the middle of equal columns, so many points along them that there are `count` in all.
  Lines(const SurfaceTopology& body, double count) : body_(body) {
    const Vec3 size = body.box.high - body.box.low;
    int w = 0;
    size.maxCoeff(&w);
    const double spacing = std::cbrt(body.volume / count);
    columns_u_ = Columns(body.box, (w + 1) % 3, spacing);
    columns_v_ = Columns(body.box, (w + 2) % 3, spacing);
    w_ = w;
    spacing_ = body.volume / (count * columns_u_.width * columns_v_.width);
    crossings_.resize(static_cast<std::size_t>(columns_u_.count) * columns_v_.count);
    for (std::size_t f = 0; f < body.mesh.faces.size(); ++f) cross(body.mesh.faces[f]);
  }

  std::vector<Vec3> points() {
    std::vector<Vec3> points;
    for (int i = 0; i < columns_u_.count; ++i) {
      for (int j = 0; j < columns_v_.count; ++j) {
        auto& heights = crossings_[index(i, j)];
        if (heights.size() % 2 != 0) continue;  // grazes the surface
        std::ranges::sort(heights);
        const double offset = fraction(0.5 + i * kPlastic1 + j * kPlastic2);
        const double low = body_.box.low[w_] + offset * spacing_;
        for (std::size_t n = 0; n + 1 < heights.size(); n += 2) {
          for (double k = std::ceil((heights[n] - low) / spacing_);; ++k) {
            const double height = low + k * spacing_;
            if (!(height < heights[n + 1])) break;
            Vec3 point;
            point[columns_u_.axis] = columns_u_.middle(i);
            point[columns_v_.axis] = columns_v_.middle(j);
            point[w_] = height;
            if (height > heights[n]) points.push_back(point);
          }
        }
      }
    }
    return points;
  }

 private:
  // Equal slices of the box along one axis.
  struct Columns {
    int axis = 0;
    int count = 1;
    double low = 0;
    double width = 1;

    Columns() = default;
    Columns(const BoundingBox& box, int axis_, double spacing) : axis(axis_), low(box.low[axis_]) {
      const double size = box.high[axis] - box.low[axis];
      count = static_cast<int>(std::clamp(std::round(size / spacing), 1.0, kMostColumns));
      width = size / count;
    }
    double middle(int n) const { return low + (n + 0.5) * width; }
    int slice(double x) const { return static_cast<int>(std::floor((x - low) / width)); }
    int first(double x) const { return std::max(0, slice(x) - 1); }
    int last(double x) const { return std::min(count - 1, slice(x) + 1); }
  };

  // Twice the area that an edge and a point span, seen along the lines, and on which side the point
  // is. Both faces at an edge see opposite values and sides, even where the point lies on it.
  struct Side {
    double area;
    bool left;
  };

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i) * columns_v_.count + static_cast<std::size_t>(j);
  }

  void cross(const Face& face) {
    const int u = columns_u_.axis, v = columns_v_.axis;
    const auto& vertices = body_.mesh.vertices;
    const Vec3 &a = vertices[face[0]], &b = vertices[face[1]], &c = vertices[face[2]];
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (int i = columns_u_.first(low[u]); i <= columns_u_.last(high[u]); ++i) {
      for (int j = columns_v_.first(low[v]); j <= columns_v_.last(high[v]); ++j) {
        const double x = columns_u_.middle(i), y = columns_v_.middle(j);
        const Side at_a = side(face[1], face[2], x, y), at_b = side(face[2], face[0], x, y),
                   at_c = side(face[0], face[1], x, y);
        if (at_a.left != at_b.left || at_a.left != at_c.left) continue;
        const double sum = at_a.area + at_b.area + at_c.area;
        if (sum == 0) continue;
        crossings_[index(i, j)].push_back(
            (at_a.area * a[w_] + at_b.area * b[w_] + at_c.area * c[w_]) / sum);
      }
    }
  }

  Side side(std::int32_t from, std::int32_t to, double x, double y) const {
    const int u = columns_u_.axis, v = columns_v_.axis;
    const Vec3& p = body_.mesh.vertices[std::min(from, to)];
    const Vec3& q = body_.mesh.vertices[std::max(from, to)];
    const double area = (q[u] - p[u]) * (y - p[v]) - (q[v] - p[v]) * (x - p[u]);
    return from < to ? Side{area, area >= 0} : Side{-area, area < 0};
  }

  const SurfaceTopology& body_;
  Columns columns_u_, columns_v_;
  int w_ = 2;
  double spacing_ = 1;
  std::vector<std::vector<double>> crossings_;
};

}  // namespace

std::vector<Vec3> interior_samples(const SurfaceTopology& body, std::size_t count,
                                   std::size_t minimum) {
  double wanted = static_cast<double>(count);
  for (int attempt = 0; attempt < 4; ++attempt, wanted *= 8) {
    std::vector<Vec3> points = Lines(body, wanted).points();
    if (points.size() >= minimum) return points;
  }
  throw MethodFailure(
      fmt::format("no {} points found inside the body; check that it is a solid", minimum));
}

}  // namespace fracbench::cvd
