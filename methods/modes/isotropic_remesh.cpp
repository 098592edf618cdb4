#include "methods/modes/isotropic_remesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

namespace fracbench::modes {

TriangleMesh isotropic_remesh(const TriangleMesh& mesh, double edge_length, int iterations) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  Surface surface;
  for (const Vec3& v : mesh.vertices) surface.add_vertex({v.x(), v.y(), v.z()});
  for (const Face& f : mesh.faces) {
    surface.add_face(Surface::Vertex_index(f[0]), Surface::Vertex_index(f[1]),
                     Surface::Vertex_index(f[2]));
  }
  CGAL::Polygon_mesh_processing::isotropic_remeshing(
      faces(surface), edge_length, surface,
      CGAL::parameters::number_of_iterations(iterations));
  surface.collect_garbage();

  TriangleMesh result;
  for (const auto v : surface.vertices()) {
    const Kernel::Point_3& p = surface.point(v);
    result.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : surface.faces()) {
    Face face{};
    int k = 0;
    for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface)) {
      face[k++] = static_cast<std::int32_t>(v.idx());
    }
    result.faces.push_back(face);
  }
  return result;
}

}  // namespace fracbench::modes
