#include "methods/modes/cage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/components.h"
#include "geometry/isosurface.h"
#include "geometry/measures.h"
#include "geometry/remesh.h"
#include "geometry/signed_distance_grid.h"
#include "geometry/surface_distance.h"
#include "methods/modes/tetrahedralise.h"

namespace fracbench::modes {
namespace {

// The surface around the shape is sampled this many times finer than the cage's edges.
constexpr double kSamplesPerEdge = 1.5;
// Distances of that surface from the shape, over the cage's edge length, that are tried in turn.
constexpr double kDistances[] = {0.25, 0.4, 0.6, 0.9, 1.4, 2};
// Finer grids than this are no coarse cages.
constexpr double kMostSamples = 3e7;

void check(const CageOptions& options) {
  const auto wrong = [](std::string_view name, auto value, std::string_view range) {
    throw InputError(fmt::format("cage: {} is {}, but must be {}", name, value, range));
  };
  if (options.target_faces < 64 || options.target_faces > 1000000) {
    wrong("target_faces", options.target_faces, "between 64 and 1000000");
  }
  if (options.target_tets < 0) wrong("target_tets", options.target_tets, "at least 0");
  if (!(options.radius_edge_ratio >= 1.1)) {
    wrong("radius_edge_ratio", options.radius_edge_ratio, "at least 1.1");
  }
  if (!(options.minimum_dihedral >= 0 && options.minimum_dihedral <= 18)) {
    wrong("minimum_dihedral", options.minimum_dihedral, "between 0 and 18 degrees");
  }
}

/// The side of an equilateral triangle, so many of which cover the area.
double edge_length(double area, std::int64_t faces) {
  return std::sqrt(4 / std::sqrt(3.0) * area / static_cast<double>(faces));
}

TriangleMesh offset_surface(const TriangleMesh& shape, double distance, double spacing,
                            int threads) {
  const BoundingBox box = bounding_box(shape);
  const double margin = distance + 3 * spacing;
  std::array<std::int32_t, 3> size;
  double samples = 1;
  for (int k = 0; k < 3; ++k) {
    const double steps = std::ceil((box.high[k] - box.low[k] + 2 * margin) / spacing);
    samples *= steps + 1;
    size[k] = static_cast<std::int32_t>(std::min(steps, 1e9)) + 1;
  }
  if (samples > kMostSamples) {
    throw MethodFailure(fmt::format(
        "a cage this fine needs a grid of {:.1g} samples; ask for fewer cage faces", samples));
  }
  VoxelGrid<float> grid(size, box.low - Vec3::Constant(margin), spacing);
  grid = signed_distance_grid(shape, std::move(grid), threads);
  return isosurface(grid, static_cast<float>(-distance));
}

TriangleMesh offset_cage(const TriangleMesh& shape, const CageOptions& options, Context& context) {
  const std::string cuts = "a surface this coarse cuts into the shape or folds";
  std::string reason = cuts;
  // Of a surface that is smoother than the shape's.
  const double edge = edge_length(area(shape), options.target_faces);
  for (const double distance : kDistances) {
    context.stop_if_asked();
    const TriangleMesh surface =
        offset_surface(shape, distance * edge, edge / kSamplesPerEdge, context.threads);
    TriangleMesh cage;
    try {
      // An isosurface has no features but the steps of its grid.
      cage = remesh(surface, "the surface around the shape",
                    {.triangles = static_cast<int>(options.target_faces),
                     .feature_angle = 180,
                     .threads = context.threads,
                     .stop = context.stop})
                 .mesh;
    } catch (const InputError& error) {
      reason = error.what();
      continue;
    }
    reason = cuts;
    if (check_mesh(cage, {.threads = context.threads}).is_solid() &&
        encloses(cage, shape, context.threads)) {
      return cage;
    }
  }
  throw MethodFailure(fmt::format(
      "no cage of {} faces was found: {}; ask for more cage faces, or use the shape itself "
      "(cage = shape)",
      options.target_faces, reason));
}

Tets refined_to(const TriangleMesh& surface, const CageOptions& options, Context& context) {
  TetrahedraliseOptions tetgen{.radius_edge_ratio = options.radius_edge_ratio,
                               .minimum_dihedral = options.minimum_dihedral};
  Tets tets = tetrahedralise(surface, tetgen, "the cage");
  const auto target = static_cast<double>(options.target_tets);
  const double solid = volume(surface);
  tetgen.largest_volume = 1.8 * solid / target;
  for (int i = 0; i < 12 && std::ssize(tets.tets) < 0.95 * target; ++i) {
    context.stop_if_asked();
    Tets finer = tetrahedralise(surface, tetgen, "the cage");
    const double ratio = static_cast<double>(finer.tets.size()) / target;
    if (ratio <= 1.05) tets = std::move(finer);
    tetgen.largest_volume *= ratio;
  }
  return tets;
}

}  // namespace

bool encloses(const TriangleMesh& cage, const TriangleMesh& shape, int threads) {
  TriangleMesh both = shape;
  const auto shift = static_cast<std::int32_t>(shape.vertices.size());
  both.vertices.insert(both.vertices.end(), cage.vertices.begin(), cage.vertices.end());
  for (const Face& f : cage.faces) {
    both.faces.push_back({f[0] + shift, f[1] + shift, f[2] + shift});
  }
  if (!self_intersections(both, threads, 1).empty()) return false;
  const auto every_shell = [](const TriangleMesh& mesh, const TriangleMesh& other, bool inside) {
    const SurfaceDistance distance(other);
    const std::vector<std::int32_t> component = face_components(mesh);
    std::int32_t next = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      if (component[f] != next) continue;
      ++next;
      if (distance.inside(mesh.corner(f, 0)) != inside) return false;
    }
    return true;
  };
  return every_shell(shape, cage, true) && every_shell(cage, shape, false);
}

TriangleMesh build_cage(const TriangleMesh& shape, const CageOptions& options, Context& context) {
  check(options);
  const auto stage = context.timer.stage("cage");
  require_solid(shape, "the shape to be caged", {.threads = context.threads});
  const bool itself =
      options.kind == CageKind::shape ||
      (options.kind == CageKind::automatic && std::ssize(shape.faces) <= options.target_faces);
  return itself ? shape : offset_cage(shape, options, context);
}

TetMesh tetrahedralise_cage(const TriangleMesh& shape, const CageOptions& options,
                            Context& context) {
  TriangleMesh surface = build_cage(shape, options, context);
  const auto stage = context.timer.stage("tetrahedra");
  const UnitBox frame = unit_box(shape);
  for (Vec3& v : surface.vertices) v = frame.to_unit(v);
  Tets tets = options.target_tets == 0
                  ? tetrahedralise(surface,
                                   {.radius_edge_ratio = options.radius_edge_ratio,
                                    .minimum_dihedral = options.minimum_dihedral},
                                   "the cage")
                  : refined_to(surface, options, context);
  return make_tet_mesh(std::move(tets.vertices), std::move(tets.tets), frame);
}

}  // namespace fracbench::modes
