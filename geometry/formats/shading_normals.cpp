#include "geometry/formats/shading_normals.h"

#include <cmath>

#include "geometry/measures.h"

namespace fracbench::formats {

namespace {

constexpr double cos_crease = 0.766;  // of 40 degrees

/// Unit; the z axis for a face without area, since a file must not hold zero normals.
Vec3 normal_or_z(const Vec3& direction) {
  const Vec3 unit = direction.stableNormalized();
  return std::abs(unit.squaredNorm() - 1) < 0.1 ? unit : Vec3::UnitZ();
}

Eigen::Vector3f to_float(const Vec3& v) { return v.cast<float>(); }

double angle_at(const TriangleMesh& mesh, std::int32_t face, int k) {
  const Vec3 u = mesh.corner(face, (k + 1) % 3) - mesh.corner(face, k);
  const Vec3 v = mesh.corner(face, (k + 2) % 3) - mesh.corner(face, k);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

ShadedFaces flat_shaded(const TriangleMesh& mesh, std::span<const std::int32_t> faces) {
  ShadedFaces result;
  for (const std::int32_t f : faces) {
    const Eigen::Vector3f normal = to_float(normal_or_z(area_vector2(mesh, f)));
    for (int k = 0; k < 3; ++k) {
      result.indices.push_back(static_cast<std::uint32_t>(result.positions.size()));
      result.positions.push_back(to_float(mesh.corner(f, k)));
      result.normals.push_back(normal);
    }
  }
  return result;
}

ShadedFaces smooth_shaded(const TriangleMesh& mesh, std::span<const std::int32_t> faces) {
  struct Corner {
    Vec3 normal;
    double angle;
  };
  std::vector<std::vector<Corner>> around(mesh.vertices.size());
  for (const std::int32_t f : faces) {
    const Vec3 normal = normal_or_z(area_vector2(mesh, f));
    for (int k = 0; k < 3; ++k) {
      around[mesh.faces[f][k]].push_back({normal, angle_at(mesh, f, k)});
    }
  }

  ShadedFaces result;
  std::vector<std::vector<std::uint32_t>> made(mesh.vertices.size());
  for (const std::int32_t f : faces) {
    const Vec3 own = normal_or_z(area_vector2(mesh, f));
    for (const std::int32_t v : mesh.faces[f]) {
      Vec3 sum = Vec3::Zero();
      for (const Corner& corner : around[v]) {
        if (corner.normal.dot(own) >= cos_crease) sum += corner.angle * corner.normal;
      }
      const Eigen::Vector3f normal = to_float(sum.isZero(0) ? own : normal_or_z(sum));
      std::uint32_t index = static_cast<std::uint32_t>(result.positions.size());
      for (const std::uint32_t other : made[v]) {
        if (result.normals[other] == normal) index = other;
      }
      if (index == result.positions.size()) {
        result.positions.push_back(to_float(mesh.vertices[v]));
        result.normals.push_back(normal);
        made[v].push_back(index);
      }
      result.indices.push_back(index);
    }
  }
  return result;
}

}  // namespace fracbench::formats
