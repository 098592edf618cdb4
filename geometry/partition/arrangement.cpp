#include "geometry/partition/arrangement.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <optional>
#include <span>

#include "core/parallel.h"
#include "geometry/exact_predicates.h"
#include "geometry/line_crossing.h"
#include "geometry/measures.h"
#include "geometry/partition/split_face.h"
#include "geometry/surface_distance.h"

namespace fracbench::partition {
namespace {

constexpr std::int32_t unknown = -1;

/// The cut faces of one of the two meshes, and into what they fall.
struct Splits {
  std::vector<std::int32_t> faces;          ///< ascending
  std::vector<std::vector<SubFace>> parts;  ///< parallel to `faces`; corners in `vertices`
};

/// One of the two meshes as seen by the other: which numbers its vertices and cuts have.
struct Side {
  const TriangleMesh& mesh;
  bool is_body;
  std::int32_t first_vertex;    ///< its vertices' place in Arrangement::vertices
  std::int32_t first_crossing;  ///< the crossings' place there
};

/// The face with the given segments (indices) on it.
FaceToSplit face_to_split(const Side& side, std::int32_t f, const Crossings& crossings,
                          const InterfaceComplex& interfaces,
                          std::span<const std::int32_t> segments) {
  FaceToSplit face;
  face.normal = area_vector2(side.mesh, f);
  std::vector<std::pair<std::int32_t, std::int32_t>> index;  // crossing to point
  const auto add_crossing = [&](std::int32_t c) {
    index.emplace_back(c, static_cast<std::int32_t>(face.points.size()));
    face.points.push_back({side.first_crossing + c, crossings.crossings[c].position});
  };
  for (int k = 0; k < 3; ++k) {
    const std::int32_t a = side.mesh.faces[f][k], b = side.mesh.faces[f][(k + 1) % 3];
    face.points.push_back({side.first_vertex + a, side.mesh.vertices[a]});
    const auto [begin, end] = crossings.on_edge(side.is_body, a, b);
    if (a < b) {
      for (std::int32_t c = begin; c < end; ++c) add_crossing(c);
    } else {
      for (std::int32_t c = end; c-- > begin;) add_crossing(c);
    }
  }
  face.rim = static_cast<std::int32_t>(face.points.size());
  std::vector<std::int32_t> inner;
  for (const std::int32_t s : segments) {
    for (const std::int32_t c : {crossings.segments[s].from, crossings.segments[s].to}) {
      if (crossings.crossings[c].body_edge != side.is_body) inner.push_back(c);
    }
  }
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  for (const std::int32_t c : inner) add_crossing(c);
  std::sort(index.begin(), index.end());
  const auto point_of = [&](std::int32_t c) {
    const auto at = std::lower_bound(index.begin(), index.end(), std::pair(c, 0));
    if (at == index.end() || at->first != c) throw NotGeneric("a cut ends beside its face");
    return at->second;
  };
  for (const std::int32_t s : segments) {
    const CutSegment& segment = crossings.segments[s];
    FaceToSplit::Cut cut;
    cut.from = point_of(segment.from);
    cut.to = point_of(segment.to);
    const auto& regions = interfaces.sides[segment.interface_face];
    cut.left = side.is_body ? regions[0] : 0;  // 0: outside the body
    cut.right = side.is_body ? regions[1] : 1;
    face.cuts.push_back(cut);
  }
  return face;
}

Splits split_faces(const Side& side, const Crossings& crossings, const InterfaceComplex& interfaces,
                   int threads) {
  const auto face_of = [&](std::int32_t s) {
    return side.is_body ? crossings.segments[s].body_face : crossings.segments[s].interface_face;
  };
  std::vector<std::int32_t> order(crossings.segments.size());
  std::iota(order.begin(), order.end(), 0);
  if (!side.is_body) {
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int32_t l, std::int32_t r) { return face_of(l) < face_of(r); });
  }
  Splits splits;
  std::vector<std::size_t> begin;
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n > 0 && face_of(order[n]) == face_of(order[n - 1])) continue;
    begin.push_back(n);
    splits.faces.push_back(face_of(order[n]));
  }
  begin.push_back(order.size());
  splits.parts.resize(splits.faces.size());
  std::atomic<bool> generic = true;
  parallel_for(
      splits.faces.size(), threads,
      [&](std::size_t n) {
        try {
          split_face(face_to_split(side, splits.faces[n], crossings, interfaces,
                                   {order.data() + begin[n], begin[n + 1] - begin[n]}),
                     splits.parts[n]);
        } catch (const NotGeneric&) {
          generic = false;
        }
      },
      64);
  if (!generic) throw NotGeneric("a face could not be divided along its cuts");
  return splits;
}

/// Which side of the cuts each vertex of a mesh is on: known at the cut faces, and the same all
/// over parts of the mesh that are not cut. `locate(vertex)` answers for parts that no cut touches.
template <typename Locate>
std::vector<std::int32_t> vertex_sides(const Side& side, const Splits& splits,
                                       const std::vector<std::uint8_t>& is_cut,
                                       const Locate& locate) {
  std::vector<std::int32_t> parent(side.mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (std::size_t f = 0; f < side.mesh.faces.size(); ++f) {
    if (is_cut[f]) continue;
    const Face& face = side.mesh.faces[f];
    for (int k = 1; k < 3; ++k) {
      const std::int32_t a = root(face[0]), b = root(face[k]);
      if (a != b) parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::int32_t> value(parent.size(), unknown);
  const auto vertex_count = static_cast<std::int32_t>(parent.size());
  for (const auto& parts : splits.parts) {
    for (const SubFace& part : parts) {
      for (const std::int32_t corner : part.corners) {
        const std::int32_t v = corner - side.first_vertex;
        if (v < 0 || v >= vertex_count || corner >= side.first_crossing) continue;
        std::int32_t& known = value[root(v)];
        if (known != unknown && known != part.side) {
          throw NotGeneric("a part of a surface is on two sides");
        }
        known = part.side;
      }
    }
  }
  for (std::size_t f = 0; f < side.mesh.faces.size(); ++f) {
    if (is_cut[f]) continue;
    std::int32_t& known = value[root(side.mesh.faces[f][0])];
    if (known == unknown) known = locate(root(side.mesh.faces[f][0]));
  }
  for (std::size_t v = 0; v < value.size(); ++v) {
    value[v] = value[root(static_cast<std::int32_t>(v))];
  }
  return value;
}

/// The region around a point that lies on no interface: that of a corner of its cell, or beyond the
/// last interface on the way from there.
std::int32_t region_in_lattice(const Vec3& point, const InterfaceMesh& interfaces,
                               const VoxelGrid<std::int32_t>& grid) {
  const Vec3 local = (point - grid.origin) / grid.spacing;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = static_cast<int>(std::floor(local.x())) + (corner & 1);
    const int j = static_cast<int>(std::floor(local.y())) + (corner >> 1 & 1);
    const int k = static_cast<int>(std::floor(local.z())) + (corner >> 2 & 1);
    const Vec3 sample = grid.position(i, j, k);
    const Vec3 low = point.cwiseMin(sample), high = point.cwiseMax(sample);
    std::int32_t region = grid.at(i, j, k);
    double nearest = 2;
    bool generic = region != 0;
    for (std::size_t f = 0; f < interfaces.mesh.faces.size() && generic; ++f) {
      const Vec3 &a = interfaces.mesh.corner(f, 0), &b = interfaces.mesh.corner(f, 1),
                 &c = interfaces.mesh.corner(f, 2);
      if ((a.cwiseMin(b).cwiseMin(c).array() > high.array()).any() ||
          (a.cwiseMax(b).cwiseMax(c).array() < low.array()).any()) {
        continue;
      }
      const int from = side_of_plane(a, b, c, point), to = side_of_plane(a, b, c, sample);
      if (from == to && from != 0) continue;
      const int s0 = side_of_plane(point, sample, a, b), s1 = side_of_plane(point, sample, b, c),
                s2 = side_of_plane(point, sample, c, a);
      if (from == 0 || to == 0 || s0 == 0 || s1 == 0 || s2 == 0) {
        generic = false;
      } else if (s0 == s1 && s1 == s2) {
        const Vec3 n = (b - a).cross(c - a);
        const double t = n.dot(a - point) / n.dot(sample - point);
        if (t < nearest) {
          nearest = t;
          region = interfaces.sides[f][from > 0 ? 1 : 0];
        }
      }
    }
    if (generic) return region;
  }
  throw NotGeneric("a vertex of the body lies on an interface");
}

/// Winding number of the body around a point that is not on its surface.
bool is_inside(const TriangleMesh& body, const Vec3& point) {
  int winding = 0;
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const Vec3 &a = body.corner(f, 0), &b = body.corner(f, 1), &c = body.corner(f, 2);
    const int crossing = line_crossing(a, b, c, point.y(), point.z());
    if (crossing != 0 && !is_beyond(a, b, c, crossing, point)) winding += crossing;
  }
  return winding != 0;
}

std::vector<std::uint8_t> flags(std::size_t count, const std::vector<std::int32_t>& set) {
  std::vector<std::uint8_t> result(count, 0);
  for (const std::int32_t n : set) result[n] = 1;
  return result;
}

}  // namespace

Arrangement arrange(const TriangleMesh& body, const InterfaceMesh& interfaces,
                    const Crossings& crossings, const LabelLattice& lattice, int threads) {
  const RegionAt region_at = [&](const Vec3& point) {
    return region_in_lattice(point, interfaces, lattice.region);
  };
  return arrange(body, interfaces, crossings, region_at, threads);
}

Arrangement arrange(const TriangleMesh& body, const InterfaceComplex& interfaces,
                    const Crossings& crossings, const RegionAt& region_at, int threads) {
  const auto body_vertices = static_cast<std::int32_t>(body.vertices.size());
  const auto all_vertices =
      static_cast<std::int32_t>(body.vertices.size() + interfaces.mesh.vertices.size());
  const Side body_side{body, true, 0, all_vertices};
  const Side interface_side{interfaces.mesh, false, body_vertices, all_vertices};
  const Splits body_splits = split_faces(body_side, crossings, interfaces, threads);
  const Splits interface_splits = split_faces(interface_side, crossings, interfaces, threads);
  const auto body_cut = flags(body.faces.size(), body_splits.faces);
  const auto interface_cut = flags(interfaces.mesh.faces.size(), interface_splits.faces);

  const auto body_region = vertex_sides(body_side, body_splits, body_cut, [&](std::int32_t v) {
    return region_at(body.vertices[v]);
  });
  constexpr int few = 32;  // for more points, a tree over the faces is quicker
  int asked = 0;
  std::optional<SurfaceDistance> surface;
  const auto interface_inside =
      vertex_sides(interface_side, interface_splits, interface_cut, [&](std::int32_t v) {
        const Vec3& point = interfaces.mesh.vertices[v];
        if (++asked <= few) return is_inside(body, point) ? 1 : 0;
        if (!surface) surface.emplace(body);
        return surface->inside(point) ? 1 : 0;
      });

  Arrangement result;
  result.vertices = body.vertices;
  result.vertices.insert(result.vertices.end(), interfaces.mesh.vertices.begin(),
                         interfaces.mesh.vertices.end());
  for (const Crossing& c : crossings.crossings) result.vertices.push_back(c.position);

  std::size_t next = 0;
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const auto source = static_cast<std::int32_t>(f);
    if (!body_cut[f]) {
      result.body.push_back({body.faces[f], body_region[body.faces[f][0]], source});
      continue;
    }
    for (const SubFace& part : body_splits.parts[next]) {
      result.body.push_back({part.corners, part.side, source});
    }
    ++next;
  }
  next = 0;
  for (std::size_t f = 0; f < interfaces.mesh.faces.size(); ++f) {
    const Face& face = interfaces.mesh.faces[f];
    if (!interface_cut[f]) {
      if (interface_inside[face[0]] == 0) continue;
      result.interfaces.push_back(
          {{face[0] + body_vertices, face[1] + body_vertices, face[2] + body_vertices},
           interfaces.sides[f]});
      continue;
    }
    for (const SubFace& part : interface_splits.parts[next]) {
      if (part.side == 1) result.interfaces.push_back({part.corners, interfaces.sides[f]});
    }
    ++next;
  }
  return result;
}

}  // namespace fracbench::partition
