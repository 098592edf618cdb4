#include "scenarios/shapes/extrusion.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace fracbench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

struct PlaneMesh {
  std::vector<Eigen::Vector2d> points;
  std::vector<Face> faces;                          ///< counter-clockwise
  std::vector<std::array<std::int32_t, 2>> border;  ///< material on the left
};

double signed_area(const Outline& outline) {
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &p = outline[i], &q = outline[(i + 1) % outline.size()];
    area += (p.x() * q.y() - p.y() * q.x()) / 2;
  }
  return area;
}

/// A point just inside a hole: beside the middle of its first edge.
Eigen::Vector2d seed(const Outline& hole) {
  const Eigen::Vector2d along = hole[1] - hole[0];
  return (hole[0] + hole[1]) / 2 + 1e-3 * Eigen::Vector2d(along.y(), -along.x());
}

PlaneMesh triangulate(const std::vector<Outline>& outlines, double spacing) {
  Triangulation triangulation;
  std::list<Kernel::Point_2> seeds;
  for (const Outline& outline : outlines) {
    std::vector<Triangulation::Vertex_handle> ring;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d &p = outline[i], &q = outline[(i + 1) % outline.size()];
      const int steps = std::max(1, static_cast<int>(std::lround((q - p).norm() / spacing)));
      for (int k = 0; k < steps; ++k) {
        const Eigen::Vector2d at = p + (q - p) * k / steps;
        ring.push_back(triangulation.insert(Kernel::Point_2(at.x(), at.y())));
      }
    }
    for (std::size_t i = 0; i < ring.size(); ++i) {
      triangulation.insert_constraint(ring[i], ring[(i + 1) % ring.size()]);
    }
    if (signed_area(outline) < 0) {
      const Eigen::Vector2d inside = seed(outline);
      seeds.emplace_back(inside.x(), inside.y());
    }
  }
  CGAL::refine_Delaunay_mesh_2(triangulation, seeds.begin(), seeds.end(),
                               Criteria(0.125, 1.3 * spacing));

  PlaneMesh mesh;
  std::map<Triangulation::Vertex_handle, std::int32_t> ids;
  for (const auto vertex : triangulation.finite_vertex_handles()) {
    ids[vertex] = static_cast<std::int32_t>(mesh.points.size());
    mesh.points.emplace_back(vertex->point().x(), vertex->point().y());
  }
  for (const auto face : triangulation.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    const auto id = [&](int k) { return ids.at(face->vertex(k)); };
    mesh.faces.push_back({id(0), id(1), id(2)});
    for (int k = 0; k < 3; ++k) {
      const auto across = face->neighbor(k);
      if (triangulation.is_infinite(across) || !across->is_in_domain()) {
        mesh.border.push_back({id((k + 1) % 3), id((k + 2) % 3)});
      }
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh extrusion(const std::vector<Outline>& outlines, double depth, double spacing) {
  const PlaneMesh plane = triangulate(outlines, spacing);
  TriangleMesh mesh;
  // The front, at y = -depth / 2, is seen with x to the right and z up: its faces are
  // counter-clockwise as they are. The back is its mirror image.
  for (const double y : {-depth / 2, depth / 2}) {
    for (const auto& p : plane.points) mesh.vertices.emplace_back(p.x(), y, p.y());
  }
  const auto count = static_cast<std::int32_t>(plane.points.size());
  for (const Face& f : plane.faces) {
    mesh.faces.push_back(f);
    mesh.faces.push_back({f[0] + count, f[2] + count, f[1] + count});
  }
  // Columns of vertices from front to back over the points of the border.
  const int steps = std::max(1, static_cast<int>(std::lround(depth / spacing)));
  std::map<std::int32_t, std::vector<std::int32_t>> columns;
  for (const auto& edge : plane.border) {
    std::vector<std::int32_t>& column = columns[edge[0]];
    column.push_back(edge[0]);
    for (int k = 1; k < steps; ++k) {
      column.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
      const Eigen::Vector2d& p = plane.points[edge[0]];
      mesh.vertices.emplace_back(p.x(), depth * k / steps - depth / 2, p.y());
    }
    column.push_back(edge[0] + count);
  }
  for (std::size_t e = 0; e < plane.border.size(); ++e) {
    const auto &from = columns[plane.border[e][0]], &to = columns[plane.border[e][1]];
    for (int k = 0; k < steps; ++k) {
      if ((e + k) % 2 == 0) {
        mesh.faces.push_back({to[k], from[k], from[k + 1]});
        mesh.faces.push_back({to[k], from[k + 1], to[k + 1]});
      } else {
        mesh.faces.push_back({to[k], from[k], to[k + 1]});
        mesh.faces.push_back({from[k], from[k + 1], to[k + 1]});
      }
    }
  }
  return mesh;
}

}  // namespace fracbench
