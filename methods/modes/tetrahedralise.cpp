#include "methods/modes/tetrahedralise.h"

#include <fmt/format.h>
#include <tetgen.h>

#include <cmath>
#include <map>
#include <string>

#include "core/error.h"
#include "geometry/surface_distance.h"

namespace fracbench::modes {
namespace {

// What TetGen throws: see terminatetetgen in tetgen.h.
std::string reason_of(int code) {
  switch (code) {
    case 1:
      return "it ran out of memory; ask for fewer cage faces or tets";
    case 2:
      return "an internal error of TetGen; another number of cage faces usually avoids it";
    case 3:
      return "the surface intersects itself; repair it, or use an offset cage (cage = offset)";
    case 4:
      return "the surface has a feature too small for double precision; remesh it, or use an "
             "offset "
             "cage (cage = offset)";
    case 5:
      return "two of its faces are too close to each other; remesh it, or use an offset cage (cage "
             "= "
             "offset)";
    case 10:
      return "TetGen cannot read the surface; check it with fracbench's mesh report";
    default:
      return fmt::format("TetGen's error {}", code);
  }
}

void fill_input(const TriangleMesh& surface, tetgenio& input) {
  input.firstnumber = 0;
  input.numberofpoints = static_cast<int>(surface.vertices.size());
  input.pointlist = new REAL[3 * surface.vertices.size()];
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    for (int k = 0; k < 3; ++k) input.pointlist[3 * i + k] = surface.vertices[i][k];
  }
  input.numberoffacets = static_cast<int>(surface.faces.size());
  input.facetlist = new tetgenio::facet[surface.faces.size()];
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    tetgenio::facet& facet = input.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(facet.polygonlist);
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    for (int k = 0; k < 3; ++k) facet.polygonlist[0].vertexlist[k] = surface.faces[f][k];
  }
}

/// Which of TetGen's regions are inside: a cavity's is not. One tet tells for its region, the one
/// with the largest volume, whose centroid is far from rounding.
std::vector<bool> tets_inside(const TriangleMesh& surface, const tetgenio& output) {
  const auto point = [&](int i) { return Eigen::Map<const Vec3>(output.pointlist + 3 * i); };
  const auto region = [&](int t) {
    return output.numberoftetrahedronattributes > 0
               ? output.tetrahedronattributelist[t * output.numberoftetrahedronattributes]
               : 0.0;
  };
  std::map<double, std::pair<double, int>> largest;  // by region: volume, tet
  for (int t = 0; t < output.numberoftetrahedra; ++t) {
    const int* c = output.tetrahedronlist + output.numberofcorners * t;
    const double volume = std::abs((point(c[1]) - point(c[0]))
                                       .cross(point(c[2]) - point(c[0]))
                                       .dot(point(c[3]) - point(c[0])));
    auto& best = largest.try_emplace(region(t), 0.0, t).first->second;
    if (volume > best.first) best = {volume, t};
  }
  const SurfaceDistance distance(surface);
  std::map<double, bool> inside;
  for (const auto& [which, best] : largest) {
    const int* c = output.tetrahedronlist + output.numberofcorners * best.second;
    inside[which] = distance.inside((point(c[0]) + point(c[1]) + point(c[2]) + point(c[3])) / 4);
  }
  std::vector<bool> result(output.numberoftetrahedra);
  for (int t = 0; t < output.numberoftetrahedra; ++t) result[t] = inside[region(t)];
  return result;
}

}  // namespace

Tets tetrahedralise(const TriangleMesh& surface, const TetrahedraliseOptions& options,
                    std::string_view name) {
  // p: a surface, A: a number for every region, Q: quiet.
  std::string switches =
      fmt::format("pAQq{:.6f}/{:.6f}", options.radius_edge_ratio, options.minimum_dihedral);
  if (options.largest_volume > 0) switches += fmt::format("a{:.15f}", options.largest_volume);
  tetgenio input, output;
  fill_input(surface, input);
  try {
    tetrahedralize(switches.data(), &input, &output);
  } catch (const int code) {
    throw MethodFailure(fmt::format("{}: tetrahedralisation failed: {}", name, reason_of(code)));
  }
  const std::vector<bool> inside = tets_inside(surface, output);

  Tets result;
  std::vector<std::int32_t> index(output.numberofpoints, -1);
  for (int t = 0; t < output.numberoftetrahedra; ++t) {
    if (!inside[t]) continue;
    Tet tet;
    for (int k = 0; k < 4; ++k) {
      const int old = output.tetrahedronlist[output.numberofcorners * t + k];
      if (index[old] < 0) {
        index[old] = static_cast<std::int32_t>(result.vertices.size());
        result.vertices.emplace_back(Eigen::Map<const Vec3>(output.pointlist + 3 * old));
      }
      tet[k] = index[old];
    }
    result.tets.push_back(tet);
  }
  if (result.tets.empty()) {
    throw MethodFailure(
        fmt::format("{}: tetrahedralisation gave no tets inside the surface; check "
                    "that it is closed and turned outwards",
                    name));
  }
  return result;
}

}  // namespace fracbench::modes
