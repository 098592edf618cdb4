#include "methods/modes/fans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace fracbench::modes {
namespace {

/// A face's edge at the vertex: towards `other` (the face is on its left) or from there.
struct Spoke {
  std::int32_t other;
  bool leaving;
  std::int32_t face;
  std::int32_t third;  ///< the face's third corner
};

/// Sorts the spokes of one edge counter-clockwise about it, seen from its far end.
void sort_around(const Vec3& from, const Vec3& to, std::span<const Vec3> vertices,
                 std::span<Spoke> spokes) {
  const Vec3 axis = (to - from).normalized();
  const Vec3 x = axis.unitOrthogonal(), y = axis.cross(x);
  std::vector<std::pair<double, Spoke>> turned;
  for (const Spoke& spoke : spokes) {
    const Vec3 arm = vertices[spoke.third] - from;
    turned.emplace_back(std::atan2(arm.dot(y), arm.dot(x)), spoke);
  }
  std::ranges::stable_sort(turned, {}, [](const auto& t) { return t.first; });
  for (std::size_t n = 0; n < spokes.size(); ++n) spokes[n] = turned[n].second;
}

}  // namespace

std::vector<std::int32_t> fans_at(std::int32_t center, std::span<const Face> faces,
                                  std::span<const Vec3> vertices) {
  std::vector<Spoke> spokes;
  spokes.reserve(2 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto k = std::ranges::find(faces[f], center) - faces[f].begin();
    const std::int32_t p = faces[f][(k + 1) % 3], q = faces[f][(k + 2) % 3];
    spokes.push_back({p, true, static_cast<std::int32_t>(f), q});
    spokes.push_back({q, false, static_cast<std::int32_t>(f), p});
  }
  std::ranges::stable_sort(spokes, {}, &Spoke::other);

  std::vector<std::int32_t> parent(faces.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  const auto join = [&](std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    parent[std::max(a, b)] = std::min(a, b);
  };
  for (std::size_t begin = 0; begin < spokes.size();) {
    std::size_t end = begin + 1;
    while (end < spokes.size() && spokes[end].other == spokes[begin].other) ++end;
    const std::span<Spoke> edge(spokes.data() + begin, end - begin);
    if (edge.size() > 2) sort_around(vertices[center], vertices[edge[0].other], vertices, edge);
    // A face that comes in along the edge has the solid on its counter-clockwise side; the wedge
    // ends at the next one.
    for (std::size_t n = 0; n < edge.size(); ++n) {
      if (!edge[n].leaving) join(edge[n].face, edge[(n + 1) % edge.size()].face);
    }
    begin = end;
  }
  std::vector<std::int32_t> fan(faces.size(), -1);
  std::int32_t count = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::int32_t first = root(static_cast<std::int32_t>(f));
    fan[f] = first == static_cast<std::int32_t>(f) ? count++ : fan[first];
  }
  return fan;
}

bool is_plain_fan(std::int32_t center, std::span<const Face> faces) {
  constexpr std::size_t most = 48;
  const std::size_t count = faces.size();
  if (count == 0 || count > most) return false;
  std::array<std::int32_t, most> leaving, arriving;  // ends of the two edges of each face
  for (std::size_t f = 0; f < count; ++f) {
    const int k = faces[f][0] == center ? 0 : faces[f][1] == center ? 1 : 2;
    leaving[f] = faces[f][(k + 1) % 3];
    arriving[f] = faces[f][(k + 2) % 3];
  }
  std::array<std::size_t, most> next;
  for (std::size_t f = 0; f < count; ++f) {
    std::size_t found = 0;
    for (std::size_t g = 0; g < count; ++g) {
      if (leaving[g] != arriving[f]) continue;
      next[f] = g;
      ++found;
    }
    if (found != 1) return false;
  }
  std::size_t steps = 0, at = 0;
  do {
    at = next[at];
    ++steps;
  } while (at != 0 && steps <= count);
  return steps == count;
}

}  // namespace fracbench::modes
