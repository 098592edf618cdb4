#include "geometry/remesh/isotropic_remesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <exception>
#include <vector>

namespace fracbench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMS = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Edge = Mesh::Edge_index;
using Vertex = Mesh::Vertex_index;

constexpr unsigned kSweeps = 5;
// Feature lines shorter than this many edges of the result are noise or detail that the result
// cannot show: they would only hold back the remeshing.
constexpr double kShortestFeature = 2.5;

std::optional<Mesh> to_cgal(const TriangleMesh& mesh) {
  Mesh result;
  result.reserve(mesh.vertices.size(), 3 * mesh.faces.size() / 2, mesh.faces.size());
  for (const Vec3& v : mesh.vertices) result.add_vertex({v.x(), v.y(), v.z()});
  for (const Face& face : mesh.faces) {
    if (result.add_face(Vertex(face[0]), Vertex(face[1]), Vertex(face[2])) == Mesh::null_face()) {
      return std::nullopt;
    }
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (result.is_isolated(Vertex(v))) result.remove_vertex(Vertex(v));
  }
  if (!CGAL::is_closed(result)) return std::nullopt;
  return result;
}

TriangleMesh from_cgal(Mesh& mesh) {
  mesh.collect_garbage();
  TriangleMesh result;
  result.vertices.reserve(mesh.number_of_vertices());
  for (const Vertex v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    Face face{};
    int k = 0;
    for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      face[k++] = static_cast<std::int32_t>(v.idx());
    }
    result.faces.push_back(face);
  }
  return result;
}

/// Takes the mark from every connected set of marked edges that is shorter than `shortest`.
template <typename Marks>
void unmark_short_lines(const Mesh& mesh, Marks& marks, double shortest) {
  std::vector<std::uint8_t> seen(mesh.num_edges(), 0);
  for (const Edge start : mesh.edges()) {
    if (!marks[start] || seen[start.idx()]) continue;
    std::vector<Edge> line{start};
    seen[start.idx()] = 1;
    double length = 0;
    for (std::size_t n = 0; n < line.size(); ++n) {
      const auto h = mesh.halfedge(line[n]);
      length +=
          std::sqrt(CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
      for (const Vertex v : {mesh.source(h), mesh.target(h)}) {
        for (const auto around : CGAL::halfedges_around_target(v, mesh)) {
          const Edge e = mesh.edge(around);
          if (!marks[e] || seen[e.idx()]) continue;
          seen[e.idx()] = 1;
          line.push_back(e);
        }
      }
    }
    if (length < shortest) {
      for (const Edge e : line) marks[e] = false;
    }
  }
}

}  // namespace

std::optional<TriangleMesh> isotropic_remesh(const TriangleMesh& mesh, double edge_length,
                                             double feature_angle) {
  try {
    std::optional<Mesh> work = to_cgal(mesh);
    if (!work) return std::nullopt;
    auto marks = work->add_property_map<Edge, bool>("e:feature", false).first;
    PMP::detect_sharp_edges(*work, feature_angle, marks);
    unmark_short_lines(*work, marks, kShortestFeature * edge_length);
    PMP::isotropic_remeshing(work->faces(), edge_length, *work,
                             CGAL::parameters::number_of_iterations(kSweeps)
                                 .edge_is_constrained_map(marks)
                                 .protect_constraints(false)
                                 .relax_constraints(true)
                                 .number_of_relaxation_steps(3));
    return from_cgal(*work);
  } catch (const std::exception&) {
    return std::nullopt;  // the library refuses: the caller tries another way
  }
}

std::optional<TriangleMesh> collapse_edges(const TriangleMesh& mesh, int triangles,
                                           CollapseOrder order) {
  try {
    std::optional<Mesh> work = to_cgal(mesh);
    if (!work) return std::nullopt;
    const auto collapse = [&](const auto& cost) {
      const SMS::Count_stop_predicate<Mesh> stop(static_cast<std::size_t>(triangles) * 3 / 2);
      SMS::edge_collapse(*work, stop,
                         CGAL::parameters::get_cost(cost)
                             .get_placement(SMS::LindstromTurk_placement<Mesh>())
                             .filter(SMS::Bounded_normal_change_filter<>()));
    };
    if (order == CollapseOrder::shortest_first) {
      collapse(SMS::Edge_length_cost<Mesh>());
    } else {
      collapse(SMS::LindstromTurk_cost<Mesh>());
    }
    return from_cgal(*work);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace fracbench
