#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <map>

#include "methods/cvd/predicates.h"
#include "methods/cvd/project.h"
#include "methods/cvd/triangulate.h"

namespace fracbench::cvd {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<std::int32_t, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_tag>;

constexpr std::int32_t kOutside = -1;

// The edges in the order of their loops, which is also an order of neighbours in space.
std::vector<BoundaryEdge> chained(std::span<const BoundaryEdge> boundary) {
  std::vector<BoundaryEdge> sorted(boundary.begin(), boundary.end());
  std::ranges::sort(sorted);
  std::vector<std::int32_t> ends;
  for (std::size_t e = 0; e < sorted.size(); ++e) {
    if (e > 0 && sorted[e][0] == sorted[e - 1][0]) throw Degenerate("a crack's outline branches");
    ends.push_back(sorted[e][1]);
  }
  std::ranges::sort(ends);
  for (std::size_t e = 0; e < sorted.size(); ++e) {
    if (ends[e] != sorted[e][0]) throw Degenerate("a crack's outline is not closed");
  }
  std::vector<BoundaryEdge> chain;
  std::vector<std::uint8_t> taken(sorted.size());
  for (std::size_t first = 0; first < sorted.size(); ++first) {
    for (std::size_t e = first; !taken[e];) {
      taken[e] = 1;
      chain.push_back(sorted[e]);
      e = std::ranges::lower_bound(sorted, sorted[e][1], {}, [](const auto& x) { return x[0]; }) -
          sorted.begin();
    }
  }
  return chain;
}

// The face to the left of from -> to, which is an edge.
Triangulation::Face_handle left_of(const Triangulation& triangulation,
                                   Triangulation::Vertex_handle from,
                                   Triangulation::Vertex_handle to) {
  Triangulation::Face_handle face;
  int side = 0;
  if (!triangulation.is_edge(from, to, face, side) || !face->is_constrained(side)) {
    throw Degenerate("a crack's outline touches itself");
  }
  return face->vertex(Triangulation::ccw(side)) == from ? face : face->neighbor(side);
}

// The vertex that each boundary edge starts from, where outlines touch: bodies that meet along an
// edge have two vertices at one place.
using Starts = std::map<std::array<Triangulation::Vertex_handle, 2>, std::int32_t>;

// The vertex at corner k of a face of the region: that of the boundary edge which the faces around
// the corner begin at.
std::int32_t corner_of(const Triangulation& triangulation, const Starts& start_of,
                       Triangulation::Face_handle face, int k) {
  const auto vertex = face->vertex(k);
  const auto first = face;
  for (;;) {
    const int i = face->index(vertex);
    const int side = Triangulation::cw(i);
    if (face->is_constrained(side)) {
      const auto found = start_of.find({vertex, face->vertex(Triangulation::ccw(i))});
      if (found == start_of.end()) throw Degenerate("a crack's outline is inside out");
      return found->second;
    }
    face = face->neighbor(side);
    if (face == first || triangulation.is_infinite(face)) {
      throw Degenerate("a crack's outline is not closed");
    }
  }
}

}  // namespace

PlanarRegion triangulate_region(std::span<const Vec3> vertices,
                                std::span<const BoundaryEdge> boundary, const Vec3& normal) {
  const std::vector<BoundaryEdge> chain = chained(boundary);
  const Axes axes = dominant_axes(normal);
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> handles;
  Triangulation::Face_handle near;
  for (const BoundaryEdge& edge : chain) {
    const Vec3& p = vertices[edge[0]];
    const std::size_t before = triangulation.number_of_vertices();
    const auto handle = triangulation.insert(Kernel::Point_2(p[axes.u], p[axes.v]), near);
    if (triangulation.number_of_vertices() == before && vertices[handle->info()] != p) {
      throw Degenerate("two corners of a crack's outline coincide");
    }
    handle->info() = edge[0];
    near = handle->face();
    handles.push_back(handle);
  }
  const bool has_touching = triangulation.number_of_vertices() != chain.size();
  std::vector<std::array<Triangulation::Vertex_handle, 2>> edges(chain.size());
  for (std::size_t e = 0, first = 0; e < chain.size(); ++e) {
    const bool last = chain[e][1] == chain[first][0];
    edges[e] = {handles[e], handles[last ? first : e + 1]};
    if (last) first = e + 1;
  }
  Starts start_of;
  if (has_touching) {
    for (std::size_t e = 0; e < chain.size(); ++e) {
      if (!start_of.emplace(edges[e], chain[e][0]).second) {
        throw Degenerate("two parts of a crack's outline coincide");
      }
    }
  }
  try {
    for (const auto& [from, to] : edges) triangulation.insert_constraint(from, to);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw Degenerate("a crack's outline crosses itself");
  }

  for (const auto face : triangulation.all_face_handles()) face->info() = kOutside;
  PlanarRegion region;
  std::vector<Triangulation::Face_handle> queue;
  for (const auto& [from, to] : edges) {
    const auto seed = left_of(triangulation, from, to);
    if (seed->info() != kOutside) continue;
    queue.assign(1, seed);
    seed->info() = region.parts;
    while (!queue.empty()) {
      const auto face = queue.back();
      queue.pop_back();
      if (triangulation.is_infinite(face)) throw Degenerate("a crack's outline is inside out");
      Face& corners = region.triangles.emplace_back();
      for (int k = 0; k < 3; ++k) {
        corners[k] =
            has_touching ? corner_of(triangulation, start_of, face, k) : face->vertex(k)->info();
      }
      region.part.push_back(region.parts);
      for (int side = 0; side < 3; ++side) {
        const auto next = face->neighbor(side);
        if (face->is_constrained(side) || next->info() != kOutside) continue;
        next->info() = region.parts;
        queue.push_back(next);
      }
    }
    ++region.parts;
  }
  for (const auto& [from, to] : edges) {
    if (left_of(triangulation, to, from)->info() != kOutside) {
      throw Degenerate("a crack's outline has the region on both sides");
    }
  }
  return region;
}

}  // namespace fracbench::cvd
