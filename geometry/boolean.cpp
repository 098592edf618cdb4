#include "geometry/boolean.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <fmt/format.h>

#include <array>
#include <exception>

#include "core/error.h"

namespace fracbench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Sources = Mesh::Property_map<Mesh::Face_index, std::int32_t>;

const char* name(BooleanOperation operation) {
  switch (operation) {
    case BooleanOperation::intersection:
      return "intersection";
    case BooleanOperation::union_of:
      return "union";
    default:
      return "difference";
  }
}

[[noreturn]] void fail(BooleanOperation operation, const std::string& reason) {
  throw MethodFailure(fmt::format("boolean {} failed: {}", name(operation), reason));
}

Sources sources(Mesh& mesh) {
  return mesh.add_property_map<Mesh::Face_index, std::int32_t>("f:source").first;
}

/// Faces get the source numbers of BooleanResult.
Mesh to_cgal(const TriangleMesh& mesh, bool second, BooleanOperation operation) {
  Mesh result;
  result.reserve(mesh.vertices.size(), 3 * mesh.faces.size() / 2, mesh.faces.size());
  Sources source = sources(result);
  for (const Vec3& v : mesh.vertices) result.add_vertex({v.x(), v.y(), v.z()});
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto vertex = [&](int k) { return Mesh::Vertex_index(mesh.faces[f][k]); };
    const Mesh::Face_index face = result.add_face(vertex(0), vertex(1), vertex(2));
    if (face == Mesh::null_face()) {
      fail(operation, fmt::format("face {} of the {} solid makes it non-manifold", f,
                                  second ? "second" : "first"));
    }
    const auto index = static_cast<std::int32_t>(f);
    source[face] = second ? -1 - index : index;
  }
  if (!CGAL::is_closed(result)) {
    fail(operation, fmt::format("the {} solid is open", second ? "second" : "first"));
  }
  return result;
}

/// Hands every new face the source of the face that it was cut from or copied from. CGAL copies
/// visitors, so that this one only points to what it changes.
struct SourceVisitor : PMP::Corefinement::Default_visitor<Mesh> {
  struct Tracked {
    std::array<const Mesh*, 3> meshes;
    std::array<Sources, 3> sources;
    std::int32_t being_cut = 0;

    Sources& of(const Mesh& mesh) {
      std::size_t k = 0;
      while (meshes[k] != &mesh) ++k;
      return sources[k];
    }
  };
  Tracked* tracked = nullptr;

  void before_subface_creations(Mesh::Face_index face, Mesh& mesh) {
    tracked->being_cut = tracked->of(mesh)[face];
  }
  void after_subface_created(Mesh::Face_index face, Mesh& mesh) {
    tracked->of(mesh)[face] = tracked->being_cut;
  }
  void after_face_copy(Mesh::Face_index from, const Mesh& from_mesh, Mesh::Face_index to,
                       Mesh& to_mesh) {
    tracked->of(to_mesh)[to] = tracked->of(from_mesh)[from];
  }
};

bool compute(BooleanOperation operation, Mesh& a, Mesh& b, Mesh& out,
             const SourceVisitor& visitor) {
  const auto parameters = CGAL::parameters::visitor(visitor).throw_on_self_intersection(true);
  switch (operation) {
    case BooleanOperation::intersection:
      return PMP::corefine_and_compute_intersection(a, b, out, parameters);
    case BooleanOperation::union_of:
      return PMP::corefine_and_compute_union(a, b, out, parameters);
    default:
      return PMP::corefine_and_compute_difference(a, b, out, parameters);
  }
}

BooleanResult from_cgal(const Mesh& mesh, const Sources& source) {
  BooleanResult result;
  std::vector<std::int32_t> index(mesh.num_vertices() + mesh.number_of_removed_vertices(), -1);
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    index[v] = static_cast<std::int32_t>(result.mesh.vertices.size());
    const Kernel::Point_3& p = mesh.point(v);
    result.mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const Mesh::Face_index f : mesh.faces()) {
    Face face{};
    int k = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
      face[k++] = index[v];
    result.mesh.faces.push_back(face);
    result.source_face.push_back(source[f]);
  }
  return result;
}

}  // namespace

BooleanResult boolean(const TriangleMesh& a, const TriangleMesh& b, BooleanOperation operation) {
  // In an array, so that whatever CGAL orders by address has the same order each time.
  std::array<Mesh, 3> meshes{to_cgal(a, false, operation), to_cgal(b, true, operation), Mesh()};
  SourceVisitor::Tracked tracked{{&meshes[0], &meshes[1], &meshes[2]}, {}};
  for (int k = 0; k < 3; ++k) tracked.sources[k] = sources(meshes[k]);

  // CGAL does not ask the visitor where one of the two is empty.
  if (a.empty() || b.empty()) {
    if (!a.empty() && operation != BooleanOperation::intersection)
      return from_cgal(meshes[0], tracked.sources[0]);
    if (!b.empty() && operation == BooleanOperation::union_of)
      return from_cgal(meshes[1], tracked.sources[1]);
    return {};
  }
  SourceVisitor visitor;
  visitor.tracked = &tracked;
  try {
    if (!compute(operation, meshes[0], meshes[1], meshes[2], visitor)) {
      fail(operation, "the result would touch itself in an edge or vertex (not manifold)");
    }
  } catch (const PMP::Corefinement::Self_intersection_exception&) {
    fail(operation, "a solid intersects itself where the two meet");
  } catch (const MethodFailure&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    fail(operation, error.what());
  }
  if (!CGAL::is_closed(meshes[2])) fail(operation, "the result is open");
  return from_cgal(meshes[2], tracked.sources[2]);
}

}  // namespace fracbench
