#include "geometry/shell_nesting.h"

#include <algorithm>
#include <limits>
#include <set>

#include "core/sum.h"
#include "geometry/exact_predicates.h"
#include "geometry/line_crossing.h"
#include "geometry/triangle_tree.h"

namespace fracbench {

namespace {

struct Box {
  Vec3 low, high;

  bool holds(const Box& other) const {
    return (low.array() <= other.low.array()).all() && (high.array() >= other.high.array()).all();
  }
};

Box box_of(const TriangleMesh& mesh, std::span<const std::int32_t> faces) {
  Box box{mesh.corner(faces[0], 0), mesh.corner(faces[0], 0)};
  for (const std::int32_t f : faces) {
    for (int k = 0; k < 3; ++k) {
      box.low = box.low.cwiseMin(mesh.corner(f, k));
      box.high = box.high.cwiseMax(mesh.corner(f, k));
    }
  }
  return box;
}

double signed_volume(const TriangleMesh& mesh, std::span<const std::int32_t> faces,
                     const Vec3& apex) {
  Sum volume6;
  for (const std::int32_t f : faces) {
    const Vec3 b = mesh.corner(f, 1) - apex;
    const Vec3 c = mesh.corner(f, 2) - apex;
    volume6 += (mesh.corner(f, 0) - apex).dot(b.cross(c));
  }
  return volume6.value() / 6;
}

/// Whether the point is exactly on the closed triangle.
bool on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
  if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) return false;
  if (side_of_plane(a, b, c, p) != 0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const auto side = [&](const Vec3& from, const Vec3& to) {
      const int x = (axis + 1) % 3, y = (axis + 2) % 3;
      return orientation({from[x], from[y]}, {to[x], to[y]}, {p[x], p[y]});
    };
    const int s0 = side(a, b), s1 = side(b, c), s2 = side(c, a);
    if ((s0 < 0 || s1 < 0 || s2 < 0) && (s0 > 0 || s1 > 0 || s2 > 0)) return false;
  }
  return true;
}

/// For one point: the shells around it (odd number of crossings of a ray), and those it is on.
class ShellsAround {
 public:
  ShellsAround(const TriangleMesh& mesh, std::span<const std::int32_t> component)
      : mesh_(mesh), component_(component), tree_(mesh) {}

  struct Answer {
    std::set<std::int32_t> around, touched;
  };

  Answer operator()(const Vec3& p) const {
    Answer answer;
    const Eigen::Vector3f q = tree_.to_box_frame(p);
    tree_.visit(
        [&](const TriangleTree::Node& node) {
          unsigned mask = 0;
          for (int k = 0; k < 4; ++k) {
            const bool meets = node.high[0][k] >= q[0] && node.low[1][k] <= q[1] &&
                               node.high[1][k] >= q[1] && node.low[2][k] <= q[2] &&
                               node.high[2][k] >= q[2];
            mask |= static_cast<unsigned>(meets) << k;
          }
          return mask;
        },
        [&](std::int32_t index) {
          const std::int32_t face = tree_.triangles()[index].face;
          const std::int32_t shell = component_[face];
          const Vec3 &a = mesh_.corner(face, 0), &b = mesh_.corner(face, 1),
                     &c = mesh_.corner(face, 2);
          if (on_triangle(a, b, c, p)) answer.touched.insert(shell);
          const int crossing = line_crossing(a, b, c, p.y(), p.z());
          if (crossing == 0 || is_beyond(a, b, c, crossing, p)) return;
          if (!answer.around.insert(shell).second) answer.around.erase(shell);
        });
    return answer;
  }

 private:
  const TriangleMesh& mesh_;
  std::span<const std::int32_t> component_;
  TriangleTree tree_;
};

/// The shells that contain shell `inner`: for each other shell, the first point of `inner` that is
/// not on it decides.
std::set<std::int32_t> shells_around(const TriangleMesh& mesh, const ShellsAround& around,
                                     std::int32_t inner, std::span<const std::int32_t> faces) {
  std::set<std::int32_t> result;
  bool first = true;
  std::set<std::int32_t> open;  // shells that every point so far was on
  const auto ask = [&](const Vec3& point) {
    const ShellsAround::Answer answer = around(point);
    if (first) {
      result = answer.around;
      open = answer.touched;
      first = false;
    } else {
      for (const std::int32_t shell : open) {
        if (answer.touched.contains(shell)) continue;
        if (answer.around.contains(shell)) result.insert(shell);
      }
      std::erase_if(open, [&](std::int32_t shell) { return !answer.touched.contains(shell); });
    }
    for (const std::int32_t shell : answer.touched) {
      if (open.contains(shell)) result.erase(shell);
    }
    open.erase(inner);
    return open.empty();
  };
  bool decided = false;
  for (std::size_t i = 0; i < faces.size() && !decided; ++i) {
    for (int k = 0; k < 3 && !decided; ++k) decided = ask(mesh.corner(faces[i], k));
  }
  // Where every vertex touches, middles of faces decide, but for their rounding.
  for (std::size_t i = 0; i < faces.size() && !decided; ++i) {
    const std::int32_t f = faces[i];
    decided = ask((mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3);
  }
  result.erase(inner);
  return result;
}

}  // namespace

ShellNesting shell_nesting(const TriangleMesh& mesh, std::span<const std::int32_t> component) {
  ShellNesting result;
  std::vector<ShellNesting::Shell>& shells = result.shells;
  for (std::size_t f = 0; f < component.size(); ++f) {
    if (component[f] >= static_cast<std::int32_t>(shells.size())) shells.resize(component[f] + 1);
    shells[component[f]].faces.push_back(static_cast<std::int32_t>(f));
  }
  std::vector<Box> boxes;
  for (ShellNesting::Shell& shell : shells) {
    boxes.push_back(box_of(mesh, shell.faces));
    shell.volume = signed_volume(mesh, shell.faces, (boxes.back().low + boxes.back().high) / 2);
  }
  if (shells.size() < 2) return result;

  const ShellsAround around(mesh, component);
  std::vector<std::set<std::int32_t>> containers(shells.size());
  for (std::size_t s = 0; s < shells.size(); ++s) {
    containers[s] = shells_around(mesh, around, static_cast<std::int32_t>(s), shells[s].faces);
    // Shells that cross, against the precondition, must not count as nested.
    std::erase_if(containers[s], [&](std::int32_t o) { return !boxes[o].holds(boxes[s]); });
    shells[s].depth = static_cast<std::int32_t>(containers[s].size());
  }
  for (std::size_t s = 0; s < shells.size(); ++s) {
    for (const std::int32_t outer : containers[s]) {
      std::int32_t& parent = shells[s].parent;
      if (parent < 0 || shells[outer].depth > shells[parent].depth) parent = outer;
    }
  }
  return result;
}

}  // namespace fracbench
