#include "methods/bem/isosurface_pieces.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/parallel.h"
#include "geometry/components.h"
#include "geometry/isosurface.h"
#include "geometry/measures.h"
#include "geometry/surface_distance.h"

namespace fracbench::bem {
namespace {

constexpr float kLevel = 0.5F;
constexpr int kMargin = 3;        // samples around a label's box
constexpr double kBeyond = 1.25;  // voxels from a face to the sample that says what is beyond it

struct Box {
  std::array<std::int32_t, 3> low{}, high{};
};

std::map<std::int32_t, Box> boxes_of(const VoxelGrid<std::int32_t>& labels) {
  std::map<std::int32_t, Box> boxes;
  for (int k = 0; k < labels.size[2]; ++k) {
    for (int j = 0; j < labels.size[1]; ++j) {
      for (int i = 0; i < labels.size[0]; ++i) {
        const std::int32_t label = labels.at(i, j, k);
        if (label == 0) continue;
        const std::array<std::int32_t, 3> at{i, j, k};
        Box& box = boxes.try_emplace(label, Box{at, at}).first->second;
        for (int a = 0; a < 3; ++a) {
          box.low[a] = std::min(box.low[a], at[a]);
          box.high[a] = std::max(box.high[a], at[a]);
        }
      }
    }
  }
  return boxes;
}

/// One pass of the kernel (1, 2, 1) / 4 along each axis.
void smooth(VoxelGrid<float>& field) {
  const std::array<std::size_t, 3> stride = {
      1, static_cast<std::size_t>(field.size[0]),
      static_cast<std::size_t>(field.size[0]) * field.size[1]};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> next(field.values.size(), 0.0F);
    const std::size_t s = stride[axis];
    for (std::size_t i = s; i + s < next.size(); ++i) {
      next[i] = 0.25F * field.values[i - s] + 0.5F * field.values[i] + 0.25F * field.values[i + s];
    }
    field.values.swap(next);
  }
}

TriangleMesh surface_of(const VoxelGrid<std::int32_t>& labels, std::int32_t label, const Box& box) {
  std::array<std::int32_t, 3> size{};
  for (int a = 0; a < 3; ++a) size[a] = box.high[a] - box.low[a] + 1 + 2 * kMargin;
  VoxelGrid<float> field(
      size, labels.position(box.low[0] - kMargin, box.low[1] - kMargin, box.low[2] - kMargin),
      labels.spacing, 0.0F);
  for (int k = box.low[2]; k <= box.high[2]; ++k) {
    for (int j = box.low[1]; j <= box.high[1]; ++j) {
      for (int i = box.low[0]; i <= box.high[0]; ++i) {
        field.at(i - box.low[0] + kMargin, j - box.low[1] + kMargin, k - box.low[2] + kMargin) =
            labels.at(i, j, k) == label ? 1.0F : 0.0F;
      }
    }
  }
  smooth(field);
  return isosurface(field, kLevel);
}

/// The convex hull; the mesh itself where the hull has no volume.
TriangleMesh hull_of(const TriangleMesh& mesh) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  std::vector<Kernel::Point_3> points;
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x(), v.y(), v.z());
  Surface surface;
  CGAL::convex_hull_3(points.begin(), points.end(), surface);
  TriangleMesh hull;
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    hull.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : surface.faces()) {
    Face face{};
    int k = 0;
    for (const auto v : CGAL::vertices_around_face(surface.halfedge(f), surface)) {
      if (k < 3) face[k++] = static_cast<std::int32_t>(v.idx());
    }
    hull.faces.push_back(face);
  }
  return volume(hull) > 0 ? hull : mesh;
}

std::int32_t label_at(const VoxelGrid<std::int32_t>& labels, const Vec3& point) {
  std::array<int, 3> at{};
  for (int a = 0; a < 3; ++a) {
    const double i = std::round((point[a] - labels.origin[a]) / labels.spacing);
    if (!(i >= 0) || i >= labels.size[a]) return 0;
    at[a] = static_cast<int>(i);
  }
  return labels.at(at[0], at[1], at[2]);
}

}  // namespace

IsosurfacePieces isosurface_pieces(const TriangleMesh& body, const VoxelGrid<std::int32_t>& labels,
                                   double hull_share, int threads) {
  const std::map<std::int32_t, Box> boxes = boxes_of(labels);
  const std::vector<std::pair<std::int32_t, Box>> list(boxes.begin(), boxes.end());
  std::vector<std::vector<TriangleMesh>> parts(list.size());
  const double hull_volume = hull_share * volume(body);
  parallel_for(list.size(), threads, [&](std::size_t n) {
    for (MeshPart& part : solid_components(surface_of(labels, list[n].first, list[n].second))) {
      const bool small = volume(part.mesh) <= hull_volume;
      parts[n].push_back(small ? hull_of(part.mesh) : std::move(part.mesh));
    }
  });
  IsosurfacePieces result;
  std::map<std::int32_t, std::int32_t> piece_of;  // the first piece of each label
  for (std::size_t n = 0; n < list.size(); ++n) {
    for (TriangleMesh& mesh : parts[n]) {
      if (mesh.empty()) continue;
      piece_of.try_emplace(list[n].first, static_cast<std::int32_t>(result.pieces.size()));
      result.pieces.push_back({.mesh = std::move(mesh), .faces = {}, .next = nullptr});
      result.label_of.push_back(list[n].first);
    }
  }
  const SurfaceDistance surface(body);
  parallel_for(result.pieces.size(), threads, [&](std::size_t p) {
    Piece& piece = result.pieces[p];
    piece.faces.resize(piece.mesh.faces.size());
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
      const Vec3 normal = area_vector2(piece.mesh, f).normalized();
      const Vec3 center =
          (piece.mesh.corner(f, 0) + piece.mesh.corner(f, 1) + piece.mesh.corner(f, 2)) / 3;
      const std::int32_t beyond = label_at(labels, center + kBeyond * labels.spacing * normal);
      if (beyond == 0) {
        piece.faces[f].parent_face = surface.nearest(center).face;
      } else if (const auto at = piece_of.find(beyond);
                 at != piece_of.end() && beyond != result.label_of[p]) {
        piece.faces[f].neighbour = at->second;
      }
    }
  });
  return result;
}

}  // namespace fracbench::bem
