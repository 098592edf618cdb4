#include "methods/modes/tet_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/sum.h"
#include "geometry/measures.h"

namespace fracbench::modes {
namespace {

// Corners of the face opposite to corner i, counter-clockwise seen from outside a tet of positive
// volume.
constexpr std::array<std::array<int, 3>, 4> kFaces = {
    {{{1, 2, 3}}, {{0, 3, 2}}, {{0, 1, 3}}, {{0, 2, 1}}}};

struct TetFace {
  std::array<std::int32_t, 3> key;  ///< corners, ascending
  std::int32_t tet;
  int face;
};

double signed_volume(const std::vector<Vec3>& vertices, const Tet& tet) {
  const Vec3& a = vertices[tet[0]];
  return (vertices[tet[1]] - a).cross(vertices[tet[2]] - a).dot(vertices[tet[3]] - a) / 6;
}

void check_indices(const std::vector<Vec3>& vertices, const std::vector<Tet>& tets) {
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (const std::int32_t corner : tets[t]) {
      if (corner < 0 || corner >= std::ssize(vertices)) {
        throw MethodFailure(fmt::format("tet {} has the vertex {}, but there are {} vertices", t,
                                        corner, vertices.size()));
      }
    }
  }
}

std::vector<TetFace> sorted_faces(const std::vector<Tet>& tets) {
  std::vector<TetFace> faces;
  faces.reserve(4 * tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (int i = 0; i < 4; ++i) {
      TetFace face{{}, static_cast<std::int32_t>(t), i};
      for (int k = 0; k < 3; ++k) face.key[k] = tets[t][kFaces[i][k]];
      std::ranges::sort(face.key);
      faces.push_back(face);
    }
  }
  std::ranges::sort(faces, [](const TetFace& a, const TetFace& b) {
    return std::tie(a.key, a.tet) < std::tie(b.key, b.tet);
  });
  return faces;
}

}  // namespace

UnitBox unit_box(const TriangleMesh& shape) {
  const BoundingBox box = bounding_box(shape);
  if (shape.empty() || !(box.longest_side() > 0)) {
    throw InputError("a shape without faces or without extent has no unit box");
  }
  return {.center = box.center(), .size = box.longest_side()};
}

double TetMesh::volume() const {
  Sum sum;
  for (const double v : volumes) sum += v;
  return sum.value();
}

TetMesh make_tet_mesh(std::vector<Vec3> vertices, std::vector<Tet> tets, const UnitBox& frame) {
  check_indices(vertices, tets);
  TetMesh mesh;
  mesh.frame = frame;
  mesh.volumes.reserve(tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    double volume = signed_volume(vertices, tets[t]);
    if (volume < 0) {
      std::swap(tets[t][2], tets[t][3]);
      volume = -volume;
    }
    if (!(volume > 0)) throw MethodFailure(fmt::format("tet {} has no volume", t));
    mesh.volumes.push_back(volume);
  }

  const std::vector<TetFace> faces = sorted_faces(tets);
  const auto outward = [&](const TetFace& face) {
    std::array<std::int32_t, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = tets[face.tet][kFaces[face.face][k]];
    return corners;
  };
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].key == faces[i].key) ++end;
    if (end - i > 2) {
      throw MethodFailure(fmt::format("{} tets share the face {}-{}-{}", end - i, faces[i].key[0],
                                      faces[i].key[1], faces[i].key[2]));
    }
    const auto corners = outward(faces[i]);
    if (end - i == 1) {
      mesh.boundary_faces.push_back({faces[i].tet, corners});
    } else {
      const Vec3& a = vertices[corners[0]];
      const double area = (vertices[corners[1]] - a).cross(vertices[corners[2]] - a).norm() / 2;
      mesh.interior_faces.push_back({{faces[i].tet, faces[i + 1].tet}, corners, area});
    }
    i = end;
  }
  std::ranges::sort(mesh.interior_faces, {}, &TetMesh::InteriorFace::tets);
  std::ranges::stable_sort(mesh.boundary_faces, {}, &TetMesh::BoundaryFace::tet);
  mesh.vertices = std::move(vertices);
  mesh.tets = std::move(tets);
  return mesh;
}

}  // namespace fracbench::modes
