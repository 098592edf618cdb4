// The coarse sheet follows the markers of its front.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "geometry/measures.h"
#include "methods/bem/front_loop.h"
#include "methods/bem/remesh_sheet.h"

namespace fracbench::bem {
namespace {

// Shares of the mesh size.
constexpr double kLongest = 1.4;
constexpr double kShortest = 0.2;
constexpr double kNewRow = 0.35;  ///< boundary vertices that move farther leave a row behind
constexpr int kPasses = 6;

constexpr std::int32_t kNone = -1;

Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

class Follower {
 public:
  Follower(Crack& crack, double size)
      : crack_(crack), mesh_(crack.sheet.mesh), front_(crack.front), size_(size) {}

  void run() {
    grow();
    collapse_boundary();
    tag_runs();
    split_boundary();
    split_long_edges(mesh_, kLongest * size_);
    collapse_short_edges(mesh_, boundary_vertices(), kShortest * size_, size_);
    compact();
    update_boundary(crack_);
    require_disc();
  }

 private:
  void grow();
  void collapse_boundary();
  void tag_runs();
  void split_boundary();
  std::vector<std::uint8_t> boundary_vertices() const;
  void compact();
  void require_disc() const;

  void split_at(std::size_t marker, std::size_t from, std::size_t to);
  std::size_t face_of_edge(std::int32_t from, std::int32_t to) const;
  const Vec3& at(std::int32_t v) const { return mesh_.vertices[v]; }

  Crack& crack_;
  TriangleMesh& mesh_;
  std::vector<FrontMarker>& front_;
  double size_;
};

std::size_t Follower::face_of_edge(std::int32_t from, std::int32_t to) const {
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    const Face& face = mesh_.faces[f];
    for (int k = 0; k < 3; ++k) {
      if (face[k] == from && face[(k + 1) % 3] == to) return f;
    }
  }
  throw MethodFailure(fmt::format("crack front: the sheet lost its boundary edge {} {}", from, to));
}

/// New rows of triangles in front of the boundary, and vertices moved where it moved little. A
/// vertex stays behind its marker for now where a triangle would turn over.
void Follower::grow() {
  enum class Change { stay, move, row };
  const std::vector<std::size_t> coarse = coarse_markers(crack_);
  const std::size_t m = coarse.size();
  std::vector<Change> change(m);
  std::vector<std::int32_t> old(m), now(m), place(mesh_.vertices.size(), kNone);
  for (std::size_t c = 0; c < m; ++c) {
    const FrontMarker& marker = front_[coarse[c]];
    const double length = (marker.position - at(marker.coarse)).norm();
    change[c] = length > kNewRow * size_ ? Change::row : length > 0 ? Change::move : Change::stay;
    old[c] = marker.coarse;
    place[old[c]] = static_cast<std::int32_t>(c);
  }
  const auto target = [&](std::size_t c) -> const Vec3& {
    return change[c] == Change::stay ? at(old[c]) : front_[coarse[c]].position;
  };
  const auto behind = [&](std::size_t c) -> const Vec3& {
    return change[c] == Change::move ? target(c) : at(old[c]);
  };
  const auto upright = [&](const Vec3& normal, const Vec3& reference) {
    return normal.norm() > 1e-3 * size_ * size_ &&
           normal.dot(reference) > 0.2 * normal.norm() * reference.norm();
  };
  /// Whether the shorter diagonal of the strip's quadrangle ends at the new place of c + 1.
  const auto across = [&](std::size_t c, std::size_t next) {
    return (at(old[c]) - target(next)).norm() < (at(old[next]) - target(c)).norm();
  };
  const auto strip_is_upright = [&](std::size_t c, std::size_t next) {
    const Vec3 reference = front_[coarse[c]].normal + front_[coarse[next]].normal;
    const bool own = change[c] == Change::row, other = change[next] == Change::row;
    if (own && other) {
      return across(c, next)
                 ? upright(normal_of(at(old[c]), target(c), target(next)), reference) &&
                       upright(normal_of(at(old[next]), at(old[c]), target(next)), reference)
                 : upright(normal_of(at(old[next]), at(old[c]), target(c)), reference) &&
                       upright(normal_of(at(old[next]), target(c), target(next)), reference);
    }
    if (own) return upright(normal_of(behind(next), at(old[c]), target(c)), reference);
    if (other) return upright(normal_of(at(old[next]), behind(c), target(next)), reference);
    return true;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (const Face& face : mesh_.faces) {
      std::array<Vec3, 3> p;
      for (int k = 0; k < 3; ++k) {
        p[k] = place[face[k]] == kNone ? at(face[k]) : behind(place[face[k]]);
      }
      const Vec3 before = normal_of(at(face[0]), at(face[1]), at(face[2]));
      if (normal_of(p[0], p[1], p[2]).dot(before) > 0.3 * before.squaredNorm()) continue;
      for (int k = 0; k < 3; ++k) {
        const std::int32_t c = place[face[k]];
        if (c == kNone || change[c] != Change::move) continue;
        change[c] = Change::stay;
        changed = true;
      }
    }
    for (std::size_t c = 0; c < m; ++c) {
      const std::size_t next = (c + 1) % m;
      if (strip_is_upright(c, next)) continue;
      for (const std::size_t end : {c, next}) {
        changed = changed || change[end] != Change::stay;
        change[end] = Change::stay;
      }
    }
  }
  for (std::size_t c = 0; c < m; ++c) {
    FrontMarker& marker = front_[coarse[c]];
    now[c] = old[c];
    if (change[c] == Change::row) {
      now[c] = static_cast<std::int32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back(marker.position);
      marker.coarse = now[c];
    } else if (change[c] == Change::move) {
      mesh_.vertices[old[c]] = marker.position;
    }
  }
  // Whoever stayed behind belongs to the marker that is nearest now.
  std::vector<std::size_t> tags = coarse;
  for (std::size_t c = 0; c < m; ++c) {
    if (change[c] != Change::stay) continue;
    const std::size_t n = front_.size(), before = tags[(c + m - 1) % m], after = tags[(c + 1) % m];
    std::size_t nearest = tags[c];
    for (std::size_t i = (before + 1) % n; i != after; i = (i + 1) % n) {
      const double length = (front_[i].position - at(old[c])).norm();
      if (length < (front_[nearest].position - at(old[c])).norm()) nearest = i;
    }
    front_[tags[c]].coarse = kNone;
    front_[nearest].coarse = old[c];
    tags[c] = nearest;
  }
  for (std::size_t c = 0; c < m; ++c) {
    const std::size_t next = (c + 1) % m;
    const bool own = now[c] != old[c], other = now[next] != old[next];
    if (own && other) {
      if ((at(old[c]) - at(now[next])).norm() < (at(old[next]) - at(now[c])).norm()) {
        mesh_.faces.push_back({old[c], now[c], now[next]});
        mesh_.faces.push_back({old[next], old[c], now[next]});
      } else {
        mesh_.faces.push_back({old[next], old[c], now[c]});
        mesh_.faces.push_back({old[next], now[c], now[next]});
      }
    } else if (own) {
      mesh_.faces.push_back({old[next], old[c], now[c]});
    } else if (other) {
      mesh_.faces.push_back({old[next], old[c], now[next]});
    }
  }
}

/// Boundary edges that have become short; a run that advances keeps a vertex.
void Follower::collapse_boundary() {
  std::vector<std::size_t> coarse = coarse_markers(crack_);
  for (std::size_t c = 0; c < coarse.size() && coarse.size() > 4;) {
    const std::size_t m = coarse.size();
    FrontMarker& a = front_[coarse[c]];
    FrontMarker& b = front_[coarse[(c + 1) % m]];
    const double length = (at(a.coarse) - at(b.coarse)).norm();
    if (length >= kShortest * size_) {
      ++c;
      continue;
    }
    const Vec3 before = at(front_[coarse[(c + m - 1) % m]].coarse);
    const Vec3 after = at(front_[coarse[(c + 2) % m]].coarse);
    // Rather the vertex that stands closer to its other neighbour goes; the other where it cannot.
    bool first = (at(a.coarse) - before).norm() < (at(b.coarse) - after).norm();
    // A vertex that advances is not given up for one that has stopped: its run would lose it.
    if (a.state != b.state) first = b.state == FrontState::advancing;
    FrontMarker* gone = first ? &a : &b;
    FrontMarker* kept = first ? &b : &a;
    if (!may_collapse(mesh_, gone->coarse, kept->coarse, size_)) {
      std::swap(gone, kept);
      if (a.state != b.state || !may_collapse(mesh_, gone->coarse, kept->coarse, size_)) {
        ++c;
        continue;
      }
    }
    collapse_edge(mesh_, gone->coarse, kept->coarse);
    gone->coarse = kNone;
    coarse = coarse_markers(crack_);
    c = c > 0 ? c - 1 : 0;
  }
}

/// Makes marker `marker`, between the coarse markers `from` and `to`, a vertex of the boundary.
void Follower::split_at(std::size_t marker, std::size_t from, std::size_t to) {
  const std::int32_t a = front_[from].coarse, b = front_[to].coarse;
  const Vec3& p = front_[marker].position;
  const std::size_t f = face_of_edge(a, b);
  std::int32_t apex = kNone;
  for (const std::int32_t v : mesh_.faces[f]) {
    if (v != a && v != b) apex = v;
  }
  const Vec3 normal = area_vector2(mesh_, f);
  const auto agrees = [&](const Vec3& other) {
    return other.norm() > 1e-3 * size_ * size_ &&
           other.dot(normal) > 0.3 * other.norm() * normal.norm();
  };
  const auto added = static_cast<std::int32_t>(mesh_.vertices.size());
  const Vec3 ear = normal_of(at(b), at(a), p);
  const bool far = ear.norm() > kNewRow * size_ * (at(a) - at(b)).norm();
  Vec3 place = p;
  if (far && agrees(ear)) {
    mesh_.faces.push_back({b, a, added});
  } else {
    // Where the marker's own place would turn a triangle over, the vertex starts on the edge.
    if (!agrees(normal_of(at(a), p, at(apex))) || !agrees(normal_of(p, at(b), at(apex)))) {
      place = 0.5 * (at(a) + at(b));
    }
    mesh_.faces[f] = {a, added, apex};
    mesh_.faces.push_back({added, b, apex});
  }
  mesh_.vertices.push_back(place);
  front_[marker].coarse = added;
}

/// Every run that advances gets a vertex.
void Follower::tag_runs() {
  const std::size_t n = front_.size();
  const std::vector<std::size_t> coarse = coarse_markers(crack_);
  for (std::size_t c = 0; c < coarse.size(); ++c) {
    const std::size_t from = coarse[c], to = coarse[(c + 1) % coarse.size()];
    if (front_[from].state == FrontState::advancing) continue;
    if (front_[to].state == FrontState::advancing) continue;
    std::vector<std::size_t> moving;
    for (std::size_t i = (from + 1) % n; i != to; i = (i + 1) % n) {
      if (front_[i].state == FrontState::advancing) moving.push_back(i);
    }
    if (!moving.empty()) split_at(moving[moving.size() / 2], from, to);
  }
}

void Follower::split_boundary() {
  const std::size_t n = front_.size();
  for (int pass = 0; pass < kPasses; ++pass) {
    bool any = false;
    const std::vector<std::size_t> coarse = coarse_markers(crack_);
    for (std::size_t c = 0; c < coarse.size(); ++c) {
      const std::size_t from = coarse[c], to = coarse[(c + 1) % coarse.size()];
      const Vec3 a = at(front_[from].coarse), b = at(front_[to].coarse);
      if ((a - b).norm() <= kLongest * size_) continue;
      // The marker that halves the edge best.
      double best = std::numeric_limits<double>::infinity();
      std::size_t middle = n;
      for (std::size_t i = (from + 1) % n; i != to; i = (i + 1) % n) {
        const double off =
            std::max((front_[i].position - a).norm(), (front_[i].position - b).norm());
        if (off < best) {
          best = off;
          middle = i;
        }
      }
      if (middle == n) continue;
      split_at(middle, from, to);
      any = true;
    }
    if (!any) break;
  }
}

std::vector<std::uint8_t> Follower::boundary_vertices() const {
  std::vector<std::uint8_t> on_boundary(mesh_.vertices.size(), 0);
  for (const FrontMarker& m : front_) {
    if (m.coarse >= 0) on_boundary[m.coarse] = 1;
  }
  return on_boundary;
}

void Follower::compact() {
  std::vector<std::int32_t> number(mesh_.vertices.size(), kNone);
  for (const Face& face : mesh_.faces) {
    for (const std::int32_t v : face) number[v] = 0;
  }
  std::int32_t count = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    mesh_.vertices[count] = mesh_.vertices[v];
    number[v] = count++;
  }
  mesh_.vertices.resize(count);
  for (Face& face : mesh_.faces) {
    for (std::int32_t& v : face) v = number[v];
  }
  for (FrontMarker& m : front_) {
    if (m.coarse >= 0) m.coarse = number[m.coarse];
  }
}

/// The boundary is one loop, and that of the markers.
void Follower::require_disc() const {
  const std::vector<std::int32_t>& loop = crack_.sheet.boundary;
  std::vector<std::int32_t> next(mesh_.vertices.size(), kNone);
  for (std::size_t c = 0; c < loop.size(); ++c) {
    if (loop[c] < 0 || next[loop[c]] != kNone) {
      throw MethodFailure("crack front: the sheet's boundary is no simple loop");
    }
    next[loop[c]] = loop[(c + 1) % loop.size()];
  }
  std::size_t boundary_edges = 0;
  for (const SheetEdge& edge : sheet_edges(mesh_)) {
    if (edge.right >= 0) continue;
    ++boundary_edges;
    if (next[edge.a] != edge.b && next[edge.b] != edge.a) {
      throw MethodFailure("crack front: the sheet has come apart");
    }
  }
  if (boundary_edges != loop.size()) {
    throw MethodFailure("crack front: the sheet has more than one boundary");
  }
}

}  // namespace

void follow_front(Crack& crack, const GrowthOptions& options) {
  Follower(crack, options.mesh_size).run();
}

}  // namespace fracbench::bem
