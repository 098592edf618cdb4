#include "geometry/partition/exact_partition.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <tuple>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/boolean.h"
#include "geometry/components.h"
#include "geometry/measures.h"
#include "geometry/partition/assemble_pieces.h"

namespace fracbench::partition {
namespace {

// Vertices of different pieces that are nearer to each other than this share of the body's size are
// one point, that CGAL rounded twice.
constexpr double same_point = 1e-14;

/// The faces around a region, outward oriented, and which faces of the interfaces they are.
MeshPart region_surface(const InterfaceMesh& interfaces, std::span<const std::int32_t> faces,
                        std::int32_t region) {
  MeshPart part;
  std::map<std::int32_t, std::int32_t> number;
  for (const std::int32_t f : faces) {
    Face face = interfaces.mesh.faces[f];
    if (interfaces.sides[f][1] == region) std::swap(face[1], face[2]);
    for (std::int32_t& v : face) {
      const auto [at, added] =
          number.try_emplace(v, static_cast<std::int32_t>(part.mesh.vertices.size()));
      if (added) part.mesh.vertices.push_back(interfaces.mesh.vertices[v]);
      v = at->second;
    }
    part.mesh.faces.push_back(face);
    part.source_face.push_back(f);
  }
  return part;
}

struct RegionPiece {
  TriangleMesh mesh;
  std::vector<std::int32_t> body_face;       ///< per face; -1: none
  std::vector<std::int32_t> interface_face;  ///< per face; -1: none
};

std::vector<RegionPiece> cut_region(const TriangleMesh& body, const InterfaceMesh& interfaces,
                                    std::span<const std::int32_t> faces, std::int32_t region) {
  const MeshPart surface = region_surface(interfaces, faces, region);
  const BooleanResult cut = boolean(body, surface.mesh, BooleanOperation::intersection);
  std::vector<RegionPiece> pieces;
  if (cut.mesh.empty()) return pieces;
  for (MeshPart& part : solid_components(cut.mesh)) {
    RegionPiece& piece = pieces.emplace_back();
    for (const std::int32_t f : part.source_face) {
      const std::int32_t source = cut.source_face[f];
      piece.body_face.push_back(source >= 0 ? source : -1);
      piece.interface_face.push_back(source >= 0 ? -1 : surface.source_face[-1 - source]);
    }
    piece.mesh = std::move(part.mesh);
  }
  return pieces;
}

/// Gives the vertices that CGAL made for one point in different pieces the same bits.
void unify_vertices(std::vector<RegionPiece>& pieces, double tolerance) {
  struct At {
    std::int32_t piece, vertex;
  };
  std::vector<At> all;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    for (std::size_t v = 0; v < pieces[p].mesh.vertices.size(); ++v) {
      all.push_back({static_cast<std::int32_t>(p), static_cast<std::int32_t>(v)});
    }
  }
  const auto place = [&](const At& at) -> Vec3& {
    return pieces[at.piece].mesh.vertices[at.vertex];
  };
  const auto key = [&](const At& at) {
    const Vec3& v = place(at);
    return std::tuple(v.x(), v.y(), v.z(), at.piece, at.vertex);
  };
  std::sort(all.begin(), all.end(), [&](const At& l, const At& r) { return key(l) < key(r); });
  std::vector<std::uint8_t> done(all.size(), 0);
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (done[n]) continue;
    const Vec3 here = place(all[n]);
    for (std::size_t m = n + 1; m < all.size() && place(all[m]).x() - here.x() <= tolerance; ++m) {
      if (done[m] || all[m].piece == all[n].piece) continue;
      if ((place(all[m]) - here).cwiseAbs().maxCoeff() > tolerance) continue;
      place(all[m]) = here;
      done[m] = 1;
    }
  }
}

}  // namespace

Partition exact_partition(const TriangleMesh& body, const InterfaceMesh& interfaces,
                          const LabelLattice& lattice, int threads) {
  const std::size_t regions = lattice.labels.size();
  std::vector<std::vector<std::int32_t>> faces(regions + 1);
  for (std::size_t f = 0; f < interfaces.sides.size(); ++f) {
    for (const std::int32_t region : interfaces.sides[f]) {
      faces[region].push_back(static_cast<std::int32_t>(f));
    }
  }
  std::vector<std::vector<RegionPiece>> of_region(regions + 1);
  parallel_for(regions, threads, [&](std::size_t n) {
    if (faces[n + 1].empty()) return;
    of_region[n + 1] = cut_region(body, interfaces, faces[n + 1], static_cast<std::int32_t>(n + 1));
  });

  Partition result;
  std::vector<RegionPiece> pieces;
  std::vector<std::int32_t> region_of;
  for (std::size_t r = 1; r <= regions; ++r) {
    for (RegionPiece& piece : of_region[r]) {
      pieces.push_back(std::move(piece));
      region_of.push_back(static_cast<std::int32_t>(r));
      result.report.piece_label.push_back(lattice.labels[r - 1]);
    }
  }
  unify_vertices(pieces, same_point * bounding_box(body).longest_side());

  // Who is on the other side of a face: a piece of the other region that has a part of the same
  // face of the interfaces; of several, the one whose part is nearest.
  struct Part {
    std::int32_t piece;
    Vec3 center;
  };
  const auto center = [](const TriangleMesh& mesh, std::size_t f) {
    return Vec3((mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3);
  };
  std::vector<std::vector<Part>> parts(interfaces.sides.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    for (std::size_t f = 0; f < pieces[p].interface_face.size(); ++f) {
      const std::int32_t face = pieces[p].interface_face[f];
      if (face >= 0)
        parts[face].push_back({static_cast<std::int32_t>(p), center(pieces[p].mesh, f)});
    }
  }
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    Piece piece;
    for (std::size_t f = 0; f < pieces[p].body_face.size(); ++f) {
      PieceFace tag{pieces[p].body_face[f], -1};
      if (tag.is_fracture()) {
        const Vec3 here = center(pieces[p].mesh, f);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Part& part : parts[pieces[p].interface_face[f]]) {
          const double distance = (part.center - here).squaredNorm();
          if (region_of[part.piece] == region_of[p] || distance >= nearest) continue;
          nearest = distance;
          tag.neighbour = part.piece;
        }
      }
      piece.faces.push_back(tag);
    }
    piece.mesh = std::move(pieces[p].mesh);
    result.pieces.push_back(std::move(piece));
  }
  report_labels(lattice.labels, result.report);
  return result;
}

}  // namespace fracbench::partition
