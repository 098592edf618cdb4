#include "synthetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace fracbench::synthetic {
namespace {

// Builds a fragment from polygons; vertices at bitwise equal places are one.
class Builder {
 public:
  void add(std::span<const Vec3> polygon, const FragmentFace& tag) {
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      fragment_.mesh.faces.push_back({index(polygon[0]), index(polygon[k - 1]), index(polygon[k])});
      fragment_.faces.push_back(tag);
    }
  }
  void add(std::initializer_list<Vec3> polygon, const FragmentFace& tag) {
    add(std::span<const Vec3>(polygon.begin(), polygon.size()), tag);
  }
  Fragment take() { return std::move(fragment_); }

 private:
  std::int32_t index(const Vec3& p) {
    const auto next = static_cast<std::int32_t>(fragment_.mesh.vertices.size());
    const auto [place, is_new] = known_.try_emplace({p.x(), p.y(), p.z()}, next);
    if (is_new) fragment_.mesh.vertices.push_back(p);
    return place->second;
  }
  Fragment fragment_;
  std::map<std::array<double, 3>, std::int32_t> known_;
};

// The same bits from either end.
Vec3 crossing(Vec3 a, Vec3 b, const Vec3& point, const Vec3& normal) {
  if (std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end())) std::swap(a, b);
  const double da = (a - point).dot(normal);
  const double db = (b - point).dot(normal);
  return a + (b - a) * (da / (da - db));
}

Fragment half(const Fragment& convex, const Vec3& point, const Vec3& normal,
              std::int32_t interface) {
  Builder builder;
  std::map<std::array<double, 3>, Vec3> rim;
  for (std::size_t f = 0; f < convex.mesh.faces.size(); ++f) {
    std::vector<Vec3> kept;
    for (int k = 0; k < 3; ++k) {
      const Vec3& a = convex.mesh.corner(f, k);
      const Vec3& b = convex.mesh.corner(f, (k + 1) % 3);
      const double da = (a - point).dot(normal);
      const double db = (b - point).dot(normal);
      if (da <= 0) kept.push_back(a);
      if (da == 0) rim[{a.x(), a.y(), a.z()}] = a;
      if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
        const Vec3 p = crossing(a, b, point, normal);
        kept.push_back(p);
        rim[{p.x(), p.y(), p.z()}] = p;
      }
    }
    if (kept.size() > 2) builder.add(kept, convex.faces[f]);
  }
  // The cap as a fan about its middle, so that points along an edge make no degenerate faces.
  std::vector<Vec3> corners;
  Vec3 middle = Vec3::Zero();
  for (const auto& [key, p] : rim) corners.push_back(p);
  for (const Vec3& p : corners) middle += p / static_cast<double>(corners.size());
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.normalized().cross(u);
  const auto angle = [&](const Vec3& p) {
    return std::atan2((p - middle).dot(v), (p - middle).dot(u));
  };
  std::ranges::sort(corners, {}, angle);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    builder.add({middle, corners[k], corners[(k + 1) % corners.size()]}, {.interface = interface});
  }
  return builder.take();
}

}  // namespace

TriangleMesh box(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                               i & 4 ? high.z() : low.z());
  }
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

Fragment whole(const TriangleMesh& body) {
  Fragment fragment{.mesh = body, .faces = {}};
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    fragment.faces.push_back({.original_face = static_cast<std::int32_t>(f)});
  }
  return fragment;
}

std::pair<Fragment, Fragment> cut(const Fragment& convex, const Vec3& point, const Vec3& normal,
                                  std::int32_t interface) {
  return {half(convex, point, normal, interface), half(convex, point, -normal, interface)};
}

Fragments cut_all(const TriangleMesh& body, const Vec3& point, std::span<const Vec3> normals) {
  Fragments fragments{whole(body)};
  std::int32_t interface = 0;
  for (const Vec3& normal : normals) {
    Fragments next;
    for (const Fragment& fragment : fragments) {
      auto [below, above] = cut(fragment, point, normal, interface++);
      next.push_back(std::move(below));
      next.push_back(std::move(above));
    }
    fragments = std::move(next);
  }
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    fragments[i].piece = static_cast<std::int32_t>(i);
  }
  return fragments;
}

Fragment slab(std::span<const Column> columns, std::int32_t bottom, std::int32_t top) {
  const auto tag = [](std::int32_t interface) {
    return interface < 0 ? FragmentFace{.original_face = 0} : FragmentFace {
      .interface = interface
    };
  };
  const FragmentFace side{.original_face = 0};
  Builder builder;
  for (std::size_t k = 1; k < columns.size(); ++k) {
    const Column& a = columns[k - 1];
    const Column& b = columns[k];
    builder.add({{a.x, 0, a.low}, {a.x, 1, a.low}, {b.x, 1, b.low}, {b.x, 0, b.low}}, tag(bottom));
    builder.add({{a.x, 0, a.high}, {b.x, 0, b.high}, {b.x, 1, b.high}, {a.x, 1, a.high}}, tag(top));
    builder.add({{a.x, 0, a.low}, {b.x, 0, b.low}, {b.x, 0, b.high}, {a.x, 0, a.high}}, side);
    builder.add({{a.x, 1, a.low}, {a.x, 1, a.high}, {b.x, 1, b.high}, {b.x, 1, b.low}}, side);
  }
  const Column& first = columns.front();
  const Column& last = columns.back();
  builder.add({{first.x, 0, first.low},
               {first.x, 0, first.high},
               {first.x, 1, first.high},
               {first.x, 1, first.low}},
              side);
  builder.add({{last.x, 0, last.low},
               {last.x, 1, last.low},
               {last.x, 1, last.high},
               {last.x, 0, last.high}},
              side);
  return builder.take();
}

Fragments corrugated_cube(int teeth, double degrees) {
  const double half_width = 0.5 / teeth;
  const double height = half_width * std::tan(degrees * std::numbers::pi / 180);
  std::vector<Column> below;
  std::vector<Column> above;
  for (int k = 0; k <= 2 * teeth; ++k) {
    const double z = 0.5 + (k % 2 == 0 ? -height / 2 : height / 2);
    below.push_back({k * half_width, 0, z});
    above.push_back({k * half_width, z, 1});
  }
  return {slab(below, -1, 0), slab(above, 0, -1)};
}

CellResult cell(const TriangleMesh& body, const Fragments& fragments,
                std::span<const Impact> impacts) {
  return {.body = body, .fragments = fragments, .impacts = impacts, .stages = {}};
}

Impact impact(const Vec3& direction) {
  Impulse impulse;
  impulse.point = Vec3::Zero();
  impulse.normal = -direction;
  impulse.direction = direction;
  impulse.magnitude = 1e5;
  Impact result;
  result.impulses.push_back(impulse);
  result.strikers.emplace_back();
  return result;
}

double value(const Measurement& measurement, std::string_view name) {
  const auto same = [&](const MetricValue& v) { return v.name == name; };
  EXPECT_EQ(std::ranges::count_if(measurement.values, same), 1) << name;
  const auto found = std::ranges::find_if(measurement.values, same);
  return found == measurement.values.end() ? std::nan("") : found->value;
}

bool has(const Measurement& measurement, std::string_view name) {
  return std::ranges::any_of(measurement.values, [&](const auto& v) { return v.name == name; });
}

const std::vector<double>& series(const Measurement& measurement, std::string_view name) {
  const auto found = std::ranges::find_if(measurement.series,
                                          [&](const MetricSeries& s) { return s.name == name; });
  static const std::vector<double> none;
  EXPECT_NE(found, measurement.series.end()) << name;
  return found == measurement.series.end() ? none : found->values;
}

}  // namespace fracbench::synthetic
