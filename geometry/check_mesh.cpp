#include "geometry/check_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "geometry/components.h"
#include "geometry/edge_table.h"
#include "geometry/equal_vertices.h"
#include "geometry/exact_predicates.h"
#include "geometry/measures.h"
#include "geometry/shell_nesting.h"

namespace fracbench {

namespace {

constexpr std::size_t most_places = 10;
constexpr std::size_t most_intersections = 1000;

std::string at(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]); }

Vec3 middle(const TriangleMesh& mesh, std::int32_t face) {
  return (mesh.corner(face, 0) + mesh.corner(face, 1) + mesh.corner(face, 2)) / 3;
}

/// Counts the findings of one kind and describes the first ones.
class Finder {
 public:
  explicit Finder(std::string kind) { finding_.kind = std::move(kind); }

  template <typename Describe>
  void add(const Describe& describe) {
    if (finding_.count++ < most_places) finding_.places.push_back(describe());
  }
  bool any() const { return finding_.count > 0; }
  void file(MeshReport& report) {
    if (any()) report.findings.push_back(std::move(finding_));
  }

 private:
  MeshReport::Finding finding_;
};

void check_values(const TriangleMesh& mesh, MeshReport& report) {
  Finder vertices("vertex not finite"), indices("index out of range");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!mesh.vertices[v].allFinite()) {
      vertices.add([&] { return fmt::format("vertex {} at {}", v, at(mesh.vertices[v])); });
    }
  }
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::int32_t v : mesh.faces[f]) {
      if (v >= 0 && v < count) continue;
      indices.add([&] { return fmt::format("vertex {} in face {}", v, f); });
    }
  }
  report.finite = !vertices.any() && !indices.any();
  vertices.file(report);
  indices.file(report);
}

void check_degenerate(const TriangleMesh& mesh, MeshReport& report) {
  Finder faces("face of zero area");
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 &a = mesh.corner(f, 0), &b = mesh.corner(f, 1), &c = mesh.corner(f, 2);
    const auto turns = [&](int x, int y) {
      return orientation({a[x], a[y]}, {b[x], b[y]}, {c[x], c[y]}) != 0;
    };
    if (turns(0, 1) || turns(1, 2) || turns(2, 0)) continue;
    faces.add([&] { return fmt::format("face {} at {}", f, at(a)); });
  }
  report.degenerate_faces = faces.any();
  faces.file(report);
}

/// For each corner (3 * face + k) of the mesh the fan of faces around its vertex, as the smallest
/// corner in it.
class Fans {
 public:
  explicit Fans(std::size_t faces) : parent_(3 * faces) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    i = root(i);
    j = root(j);
    if (i != j) parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Open, non-manifold and inconsistent edges, non-manifold vertices.
void check_edges(const TriangleMesh& mesh, MeshReport& report) {
  Finder open("open edge"), crowded("non-manifold edge"), turned("edge between opposed faces"),
      pinched("non-manifold vertex");
  Fans fans(mesh.faces.size());
  EdgeTable(mesh).for_each_edge([&](std::int32_t low, std::int32_t high, const auto& sides) {
    const auto describe = [&] {
      return fmt::format("edge {}-{} at {}", low, high,
                         at((mesh.vertices[low] + mesh.vertices[high]) / 2));
    };
    std::size_t forward = 0;
    for (const EdgeTable::Side& side : sides) {
      forward += side.forward;
      const auto corner = [&](const EdgeTable::Side& s, bool of_low) {
        return 3 * static_cast<std::size_t>(s.face) + (s.forward == of_low ? s.k : (s.k + 1) % 3);
      };
      fans.join(corner(sides[0], true), corner(side, true));
      fans.join(corner(sides[0], false), corner(side, false));
    }
    if (sides.size() == 1) open.add(describe);
    if (sides.size() > 2) {
      crowded.add([&] { return fmt::format("{} ({} faces)", describe(), sides.size()); });
    }
    if (sides.size() > 1 && 2 * forward != sides.size()) turned.add(describe);
  });

  std::vector<std::int64_t> fan(mesh.vertices.size(), -1);
  std::vector<std::uint8_t> reported(mesh.vertices.size(), 0);
  for (std::size_t corner = 0; corner < 3 * mesh.faces.size(); ++corner) {
    const std::int32_t v = mesh.faces[corner / 3][corner % 3];
    const auto root = static_cast<std::int64_t>(fans.root(corner));
    if (fan[v] < 0) fan[v] = root;
    if (fan[v] == root || reported[v]) continue;
    reported[v] = 1;
    pinched.add([&] { return fmt::format("vertex {} at {}", v, at(mesh.vertices[v])); });
  }

  report.closed = !open.any() && !mesh.empty();
  report.manifold = !crowded.any() && !pinched.any();
  report.oriented = !turned.any();
  open.file(report);
  crowded.file(report);
  pinched.file(report);
  turned.file(report);
  if (report.closed) return;

  Finder duplicates("vertex at the place of another");
  const std::vector<std::int32_t> first = first_equal_vertex(mesh.vertices);
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (first[v] == static_cast<std::int32_t>(v)) continue;
    duplicates.add(
        [&] { return fmt::format("vertices {} and {} at {}", first[v], v, at(mesh.vertices[v])); });
  }
  duplicates.file(report);
}

/// Outer shells must have positive volume, the shells of cavities negative.
void check_shells(const TriangleMesh& mesh, MeshReport& report) {
  const std::vector<std::int32_t> component = face_components(mesh);
  for (const std::int32_t c : component) {
    report.components = std::max<std::size_t>(report.components, c + 1);
  }
  report.volume = volume(mesh);
  if (!report.closed) return;
  Finder inverted("inverted shell"), flat("shell without volume"),
      vast("shell of a volume beyond all numbers");
  for (const ShellNesting::Shell& shell : shell_nesting(mesh, component).shells) {
    const bool cavity = shell.depth % 2 == 1;
    const bool measured = std::isfinite(shell.volume);
    if (measured && (cavity ? shell.volume < 0 : shell.volume > 0)) continue;
    Finder& kind = shell.volume == 0 ? flat : measured ? inverted : vast;
    kind.add([&] {
      return fmt::format("{} of {} faces with face {} at {}, volume {:.6g}",
                         cavity ? "cavity" : "shell", shell.faces.size(), shell.faces[0],
                         at(middle(mesh, shell.faces[0])), shell.volume);
    });
  }
  if (inverted.any() || flat.any() || vast.any()) report.oriented = false;
  inverted.file(report);
  flat.file(report);
  vast.file(report);
}

void check_intersections(const TriangleMesh& mesh, int threads, MeshReport& report) {
  Finder pairs("self-intersection");
  for (const auto& [f, g] : self_intersections(mesh, threads, most_intersections)) {
    pairs.add([&, f = f, g = g] {
      return fmt::format("faces {} at {} and {} at {}", f, at(middle(mesh, f)), g,
                         at(middle(mesh, g)));
    });
  }
  report.self_intersecting = pairs.any();
  pairs.file(report);
}

}  // namespace

bool MeshReport::is_solid() const {
  return faces > 0 && finite && closed && manifold && oriented && volume > 0 && !self_intersecting;
}

std::string MeshReport::describe() const {
  if (findings.empty()) return "solid";
  std::string text;
  for (const Finding& finding : findings) {
    const bool capped = finding.kind == "self-intersection" && finding.count >= most_intersections;
    text += fmt::format("{}{}: {}{}", text.empty() ? "" : "\n", finding.kind, finding.count,
                        capped ? " or more" : "");
    for (std::size_t i = 0; i < finding.places.size(); ++i) {
      text += (i == 0 ? " (" : "; ") + finding.places[i];
    }
    if (finding.places.empty()) continue;
    text += finding.count > finding.places.size() ? "; ...)" : ")";
  }
  return text;
}

MeshReport check_mesh(const TriangleMesh& mesh, const CheckOptions& options) {
  MeshReport report;
  report.vertices = mesh.vertices.size();
  report.faces = mesh.faces.size();
  if (mesh.empty()) report.findings.push_back({"no faces", 1, {}});
  check_values(mesh, report);
  if (!report.finite) return report;
  check_degenerate(mesh, report);
  check_edges(mesh, report);
  check_shells(mesh, report);
  if (options.self_intersections) check_intersections(mesh, options.threads, report);
  return report;
}

void require_solid(const TriangleMesh& mesh, std::string_view name, const CheckOptions& options) {
  const MeshReport report = check_mesh(mesh, options);
  if (report.is_solid()) return;
  throw InputError(fmt::format(
      "'{}' does not bound a solid (vertices and faces counted from 0):\n{}\n"
      "It must be closed, manifold, turned outward and free of self-intersections: mend it in a "
      "mesh editor (Blender with the 3D-Print toolbox, MeshLab) and try again.",
      name, report.describe()));
}

}  // namespace fracbench
