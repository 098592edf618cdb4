#include "geometry/partition/split_face.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <limits>

#include "geometry/partition/crossings.h"

namespace fracbench::partition {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<std::int32_t, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_tag>;

constexpr std::int32_t unknown = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t outside = unknown + 1;

/// Gives `face` and all that is connected to it without crossing a constraint the value `side`.
void flood(Triangulation::Face_handle face, std::int32_t side) {
  if (face->info() == side) return;
  if (face->info() != unknown) throw NotGeneric("the sides of a cut contradict each other");
  std::vector<Triangulation::Face_handle> stack{face};
  face->info() = side;
  while (!stack.empty()) {
    const auto f = stack.back();
    stack.pop_back();
    for (int k = 0; k < 3; ++k) {
      if (f->is_constrained(k)) continue;
      const auto other = f->neighbor(k);
      if (other->info() == side) continue;
      if (other->info() != unknown) throw NotGeneric("the sides of a cut contradict each other");
      other->info() = side;
      stack.push_back(other);
    }
  }
}

}  // namespace

void split_face(const FaceToSplit& face, std::vector<SubFace>& result) {
  int axis = 0;
  face.normal.cwiseAbs().maxCoeff(&axis);
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (face.normal[axis] < 0) std::swap(u, v);

  Triangulation cdt;
  std::vector<Triangulation::Vertex_handle> handles(face.points.size());
  Triangulation::Face_handle hint;
  for (std::size_t n = 0; n < face.points.size(); ++n) {
    const Vec3& p = face.points[n].position;
    handles[n] = cdt.insert(Kernel::Point_2(p[u], p[v]), hint);
    hint = handles[n]->face();
    if (cdt.number_of_vertices() != n + 1) throw NotGeneric("two crossings coincide");
    handles[n]->info() = face.points[n].number;
  }
  try {
    for (std::int32_t n = 0; n < face.rim; ++n) {
      cdt.insert_constraint(handles[n], handles[(n + 1) % face.rim]);
    }
    for (const auto& cut : face.cuts) cdt.insert_constraint(handles[cut.from], handles[cut.to]);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    throw NotGeneric("cuts cross after rounding");
  }
  for (auto f = cdt.all_faces_begin(); f != cdt.all_faces_end(); ++f) f->info() = unknown;
  flood(cdt.infinite_face(), outside);
  // The face on the left of an edge from p to q: the edge is its k-th, counter-clockwise.
  const auto left_of = [&](Triangulation::Vertex_handle p, Triangulation::Vertex_handle q) {
    Triangulation::Face_handle f;
    int k = 0;
    if (!cdt.is_edge(p, q, f, k)) throw NotGeneric("a cut runs through another crossing");
    return f->vertex(Triangulation::cw(k)) == q ? f : f->neighbor(k);
  };
  for (std::int32_t n = 0; n < face.rim; ++n) left_of(handles[n], handles[(n + 1) % face.rim]);
  for (const auto& cut : face.cuts) {
    flood(left_of(handles[cut.from], handles[cut.to]), cut.left);
    flood(left_of(handles[cut.to], handles[cut.from]), cut.right);
  }
  for (auto f = cdt.finite_faces_begin(); f != cdt.finite_faces_end(); ++f) {
    if (f->info() == outside) continue;
    if (f->info() == unknown) throw NotGeneric("a part of a face touches no cut");
    result.push_back(
        {{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()}, f->info()});
  }
}

}  // namespace fracbench::partition
