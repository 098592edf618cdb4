#include "methods/cvd/cut_by_cells.h"

#include <algorithm>

#include "core/parallel.h"
#include "geometry/check_mesh.h"
#include "methods/cvd/cut_cracks.h"
#include "methods/cvd/cut_surface.h"
#include "methods/cvd/predicates.h"
#include "methods/cvd/triangulate.h"

namespace fracbench::cvd {

namespace {

void place_surface_vertices(const SurfaceTopology& body, const VoronoiCells& cells,
                            const SurfaceCut& surface, int threads, CellComplex& complex) {
  const auto& mesh = body.mesh;
  const std::size_t first = mesh.vertices.size();
  complex.vertices.resize(first + surface.vertices.size());
  complex.cells_at.resize(complex.vertices.size(), {-1, -1, -1, -1});
  std::ranges::copy(mesh.vertices, complex.vertices.begin());
  for (std::size_t v = 0; v < first; ++v) complex.cells_at[v][0] = surface.owner[v];
  parallel_for(
      surface.vertices.size(), threads,
      [&](std::size_t n) {
        const SurfaceVertex& vertex = surface.vertices[n];
        const auto& [i, j, k] = vertex.sites;
        complex.cells_at[first + n] = {i, j, k, -1};
        if (vertex.on_edge()) {
          const auto& [a, b] = body.edges[vertex.place];
          complex.vertices[first + n] =
              point_on_edge(mesh.vertices[a], mesh.vertices[b], cells.sites[i], cells.sites[j]);
        } else {
          const Face& face = mesh.faces[vertex.place];
          complex.vertices[first + n] = point_in_triangle(
              {mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]},
              cells.sites[i], cells.sites[j], cells.sites[k]);
        }
      },
      64);
}

void place_inner_vertices(const VoronoiCells& cells, const CrackOutlines& cracks,
                          CellComplex& complex) {
  for (const std::int32_t v : cracks.inner_vertices) {
    const auto& [i, j, k, l] = cells.vertices[v].sites;
    complex.vertices.push_back(
        voronoi_vertex(cells.sites[i], cells.sites[j], cells.sites[k], cells.sites[l]));
    complex.cells_at.push_back({i, j, k, l});
  }
}

// Polygons of more than three corners are divided; where their triangles go is known beforehand.
void triangulate_surface(const SurfaceTopology& body, const SurfaceCut& surface, int threads,
                         CellComplex& complex) {
  std::vector<std::size_t> first;
  std::size_t count = 0;
  for (const auto& polygon : surface.polygons) {
    first.push_back(count);
    count += polygon.size - 2;
  }
  complex.surface.resize(count);
  parallel_for(
      surface.polygons.size(), threads,
      [&](std::size_t n) {
        const auto& [face, cell, begin, size] = surface.polygons[n];
        const std::span corners(surface.corners.data() + begin, static_cast<std::size_t>(size));
        if (size == 3) {
          complex.surface[first[n]] = {{corners[0], corners[1], corners[2]}, cell, face};
          return;
        }
        std::size_t to = first[n];
        for (const Face& triangle :
             triangulate_polygon(complex.vertices, corners, area_vector2(body.mesh, face))) {
          complex.surface[to++] = {triangle, cell, face};
        }
      },
      512);
}

void triangulate_cracks(const VoronoiCells& cells, const CrackOutlines& cracks, int threads,
                        CellComplex& complex) {
  std::vector<PlanarRegion> regions(cracks.outlines.size());
  parallel_for(regions.size(), threads, [&](std::size_t n) {
    const auto& [pair, edges] = cracks.outlines[n];
    regions[n] =
        triangulate_region(complex.vertices, edges, cells.sites[pair[1]] - cells.sites[pair[0]]);
  });
  for (std::size_t n = 0; n < regions.size(); ++n) {
    for (const Face& triangle : regions[n].triangles) {
      complex.cracks.push_back({triangle, cracks.outlines[n].cells});
    }
  }
}

// The shortest edge that the cut made. Rounding must not have joined its ends.
double shortest_edge(const SurfaceTopology& body, const SurfaceCut& surface,
                     const CrackOutlines& cracks, const CellComplex& complex) {
  double shortest = std::numeric_limits<double>::infinity();
  const auto first_new = static_cast<std::int32_t>(body.mesh.vertices.size());
  const auto look_at = [&](std::int32_t a, std::int32_t b) {
    if (std::max(a, b) < first_new) return;
    shortest = std::min(shortest, (complex.vertices[a] - complex.vertices[b]).norm());
  };
  for (const auto& polygon : surface.polygons) {
    for (std::int32_t n = 0; n < polygon.size; ++n) {
      look_at(surface.corners[polygon.first + n],
              surface.corners[polygon.first + (n + 1) % polygon.size]);
    }
  }
  for (const CrackOutline& outline : cracks.outlines) {
    for (const auto& [a, b] : outline.edges) look_at(a, b);
  }
  if (shortest == 0) throw Degenerate("two corners of a cell coincide");
  return shortest;
}

bool has_crossings(const CellComplex& complex, int threads) {
  TriangleMesh mesh{complex.vertices, {}};
  for (const SurfaceTriangle& triangle : complex.surface) mesh.faces.push_back(triangle.corners);
  for (const CrackTriangle& triangle : complex.cracks) mesh.faces.push_back(triangle.corners);
  return !self_intersections(mesh, threads, 1).empty();
}

// Rounding moves a vertex by e. Where three vertices of an outline lie on a line (on coplanar faces
// of the body), a distance d apart, that bends the line to a circle of radius d^2 / 2e. While the
// radius is larger than the body, Delaunay triangles connect the middle one with the inside; below
// that they may bridge it, and cross the surface.
bool is_delicate(const SurfaceTopology& body, double shortest) {
  constexpr double kMargin = 10;
  const double rounding = body.scale * std::numeric_limits<double>::epsilon();
  return shortest * shortest < kMargin * 2 * rounding * body.box.longest_side();
}

}  // namespace

CellComplex cut_by_cells(const SurfaceTopology& body, const VoronoiCells& cells, int threads) {
  CellComplex complex;
  const SurfaceCut surface = cut_surface(body, cells, threads);
  place_surface_vertices(body, cells, surface, threads, complex);
  const CrackOutlines cracks = crack_outlines(body, cells, surface, complex.vertices);
  place_inner_vertices(cells, cracks, complex);
  complex.shortest_edge = shortest_edge(body, surface, cracks, complex);
  triangulate_surface(body, surface, threads, complex);
  triangulate_cracks(cells, cracks, threads, complex);
  if (is_delicate(body, complex.shortest_edge) && has_crossings(complex, threads) &&
      self_intersections(body.mesh, threads, 1).empty()) {
    throw Degenerate("two faces cross by rounding");
  }
  return complex;
}

}  // namespace fracbench::cvd
