#include "methods/bem/validation/crack_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "core/error.h"

namespace fracbench::bem {

CrackSheet disc_crack(double radius, int rings, double grading) {
  CrackSheet disc;
  disc.mesh.vertices.push_back(Vec3::Zero());
  const auto first_of = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= rings; ++ring) {
    const double s = static_cast<double>(ring) / rings;
    const double r = radius * (s + grading * (std::sin(std::numbers::pi / 2 * s) - s));
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = 2 * std::numbers::pi * i / (6 * ring);
      disc.mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
    for (int sector = 0; sector < 6; ++sector) {
      const auto outer = [&](int i) { return first_of(ring) + (sector * ring + i) % (6 * ring); };
      const auto inner = [&](int i) {
        return ring == 1 ? 0 : first_of(ring - 1) + (sector * (ring - 1) + i) % (6 * (ring - 1));
      };
      for (int i = 0; i < ring; ++i) {
        disc.mesh.faces.push_back({outer(i), outer(i + 1), inner(i)});
        if (i + 1 < ring) disc.mesh.faces.push_back({outer(i + 1), inner(i + 1), inner(i)});
      }
    }
  }
  for (int i = 0; i < 6 * rings; ++i) disc.boundary.push_back(first_of(rings) + i);
  disc.states.assign(disc.boundary.size(), FrontState::advancing);
  return disc;
}

std::vector<std::int32_t> boundary_loop(const TriangleMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> directed;
  for (const Face& face : mesh.faces) {
    for (int k = 0; k < 3; ++k) ++directed[{face[k], face[(k + 1) % 3]}];
  }
  std::map<std::int32_t, std::int32_t> next;
  for (const auto& [edge, count] : directed) {
    if (!directed.contains({edge.second, edge.first})) next[edge.first] = edge.second;
  }
  std::vector<std::int32_t> loop;
  if (!next.empty()) {
    std::int32_t at = next.begin()->first;
    do {
      loop.push_back(at);
      const auto after = next.find(at);
      at = after == next.end() ? loop.front() : after->second;
    } while (at != loop.front() && loop.size() <= next.size());
  }
  if (loop.empty() || loop.size() != next.size()) {
    throw InputError("a sheet must have one boundary loop; this one has " +
                     std::to_string(next.size()) + " boundary edges, " +
                     std::to_string(loop.size()) + " of them in the first loop");
  }
  return loop;
}

TriangleMesh grid_box(std::span<const double> xs, std::span<const double> ys,
                      std::span<const double> zs) {
  const std::array<std::span<const double>, 3> lines{xs, ys, zs};
  TriangleMesh box;
  std::map<std::array<std::size_t, 3>, std::int32_t> vertex_at;
  const auto vertex = [&](const std::array<std::size_t, 3>& at) {
    const auto [found, fresh] =
        vertex_at.try_emplace(at, static_cast<std::int32_t>(box.vertices.size()));
    if (fresh) box.vertices.emplace_back(xs[at[0]], ys[at[1]], zs[at[2]]);
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (const bool high : {false, true}) {
      for (std::size_t i = 0; i + 1 < lines[u].size(); ++i) {
        for (std::size_t j = 0; j + 1 < lines[v].size(); ++j) {
          const auto corner = [&](std::size_t di, std::size_t dj) {
            std::array<std::size_t, 3> at{};
            at[axis] = high ? lines[axis].size() - 1 : 0;
            at[u] = i + di;
            at[v] = j + dj;
            return vertex(at);
          };
          const std::array<std::int32_t, 4> quad{corner(0, 0), corner(1, 0), corner(1, 1),
                                                 corner(0, 1)};
          const bool flip = (i + j) % 2 == 1;  // alternating diagonals: no preferred direction
          for (Face face :
               {flip ? Face{quad[0], quad[1], quad[3]} : Face{quad[0], quad[1], quad[2]},
                flip ? Face{quad[1], quad[2], quad[3]} : Face{quad[0], quad[2], quad[3]}}) {
            if (!high) std::swap(face[1], face[2]);
            box.faces.push_back(face);
          }
        }
      }
    }
  }
  return box;
}

std::vector<double> graded(double low, double high, int count, double ratio) {
  const double factor = count > 1 ? std::pow(ratio, 1.0 / (count - 1)) : 1;
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += std::pow(factor, i);
  std::vector<double> points;
  double at = low;
  for (int i = 0; i < count; ++i) {
    at += (high - low) / sum * std::pow(factor, i);
    points.push_back(i + 1 == count ? high : at);
  }
  return points;
}

namespace {

/// `right`, and left of 0 its mirror image, ascending, with 0 between.
std::vector<double> mirrored(const std::vector<double>& right) {
  std::vector<double> all;
  for (auto at = right.rbegin(); at != right.rend(); ++at) all.push_back(-*at);
  all.push_back(0);
  all.insert(all.end(), right.begin(), right.end());
  return all;
}

void set_states(CrackSheet& crack, const auto& on_front) {
  crack.boundary = boundary_loop(crack.mesh);
  for (const std::int32_t v : crack.boundary) {
    crack.states.push_back(on_front(crack.mesh.vertices[v]) ? FrontState::advancing
                                                            : FrontState::at_surface);
  }
}

}  // namespace

CrackedBody edge_cracked_strip(const StripShape& shape) {
  const double a = shape.depth;
  std::vector<double> xs{0};
  for (int i = 1; i <= shape.steps; ++i) {
    const double s = static_cast<double>(i) / shape.steps;
    xs.push_back(a * (0.6 * s + 0.2 * (1 - std::cos(std::numbers::pi * s))));
  }
  xs.back() = a;
  const double fine = xs.back() - xs[xs.size() - 2];
  // Outwards the steps grow by about 1.6 each.
  const auto count = [&](double length) {
    return std::max(3, static_cast<int>(std::log(1 + 0.6 * length / fine) / std::log(1.6) + 0.5));
  };
  const int rest = count(1 - a);
  for (const double x : graded(a, 1, rest, std::pow(1.6, rest - 1))) xs.push_back(x);
  const int up = count(shape.half_height);
  const std::vector<double> ys = mirrored(graded(0, shape.half_height, up, std::pow(1.6, up - 1)));
  std::vector<double> zs;
  for (int i = 0; i <= shape.layers; ++i) {
    zs.push_back(shape.thickness * (static_cast<double>(i) / shape.layers - 0.5));
  }
  CrackedBody body{.surface = grid_box(xs, ys, zs), .crack = {}};
  const int n = shape.steps;
  for (int j = 0; j <= shape.layers; ++j) {
    for (int i = 0; i <= n; ++i) body.crack.mesh.vertices.emplace_back(xs[i], 0, zs[j]);
  }
  for (int j = 0; j < shape.layers; ++j) {
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i;
      const std::array<int, 4> quad{v, v + n + 1, v + n + 2, v + 1};  // counter-clockwise from +y
      if ((i + j) % 2 == 0) {
        body.crack.mesh.faces.push_back({quad[0], quad[1], quad[2]});
        body.crack.mesh.faces.push_back({quad[0], quad[2], quad[3]});
      } else {
        body.crack.mesh.faces.push_back({quad[0], quad[1], quad[3]});
        body.crack.mesh.faces.push_back({quad[1], quad[2], quad[3]});
      }
    }
  }
  set_states(body.crack,
             [&](const Vec3& p) { return p.x() == a && std::abs(p.z()) < shape.thickness / 2; });
  return body;
}

CrackedBody half_penny_block(double size, int rings) {
  std::vector<double> right;
  for (int k = 1; k <= rings; ++k) right.push_back(static_cast<double>(k) / rings);
  const double fine = 1.0 / rings;
  const int rest =
      std::max(2, static_cast<int>(std::log(1 + 0.8 * (size - 1) / fine) / std::log(1.8) + 0.5));
  for (const double x : graded(1, size, rest, std::pow(1.8, rest - 1))) right.push_back(x);
  const int up = rest + 1;
  const std::vector<double> ys = mirrored(graded(0, size, up, std::pow(1.8, up - 1)));
  std::vector<double> zs;
  const int down = 4;
  const std::vector<double> depths = graded(0, size, down, 3);
  for (auto at = depths.rbegin(); at != depths.rend(); ++at) zs.push_back(-*at);
  zs.push_back(0);
  CrackedBody body{.surface = grid_box(mirrored(right), ys, zs), .crack = {}};

  // Half of the disc's rings, turned into the plane y = 0 with its straight side along x.
  TriangleMesh& mesh = body.crack.mesh;
  mesh.vertices.push_back(Vec3::Zero());
  const auto first_of = [](int ring) {
    return ring == 0 ? 0 : 1 + (3 * ring + 2) * (ring - 1) / 2;
  };
  for (int ring = 1; ring <= rings; ++ring) {
    const double r = right[ring - 1];
    for (int i = 0; i <= 3 * ring; ++i) {
      const double angle = std::numbers::pi * i / (3 * ring);
      const bool end = i == 0 || i == 3 * ring;
      mesh.vertices.emplace_back(end ? (i == 0 ? r : -r) : r * std::cos(angle), 0,
                                 end ? 0 : -r * std::sin(angle));
    }
    for (int sector = 0; sector < 3; ++sector) {
      const int outer = first_of(ring) + sector * ring;
      const int inner = first_of(ring - 1) + sector * (ring - 1);
      for (int i = 0; i < ring; ++i) {
        mesh.faces.push_back({outer + i, outer + i + 1, inner + i});
        if (i + 1 < ring) mesh.faces.push_back({outer + i + 1, inner + i + 1, inner + i});
      }
    }
  }
  set_states(body.crack, [](const Vec3& p) { return p.z() < 0 && p.norm() > 1 - 1e-9; });
  return body;
}

}  // namespace fracbench::bem
