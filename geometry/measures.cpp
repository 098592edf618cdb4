#include "geometry/measures.h"

#include <limits>

#include "core/sum.h"

namespace fracbench {

namespace {

/// Sum of vectors or matrices, compensated in every entry.
template <typename T>
class EntrywiseSum {
 public:
  EntrywiseSum& operator+=(const T& term) {
    for (Eigen::Index i = 0; i < T::SizeAtCompileTime; ++i) entries_[i] += term.data()[i];
    return *this;
  }
  T value() const {
    T result;
    for (Eigen::Index i = 0; i < T::SizeAtCompileTime; ++i) result.data()[i] = entries_[i].value();
    return result;
  }

 private:
  Sum entries_[T::SizeAtCompileTime];
};

}  // namespace

MassProperties mass_properties(const TriangleMesh& mesh) {
  // The solid is the signed sum of the tetrahedra from one apex to every face. With corners a, b,
  // c as seen from the apex and s = a + b + c, a tetrahedron of six-fold volume d contributes
  // d/6 to the volume, d/24 s to the first moment and d/120 (s s' + a a' + b b' + c c') to the
  // second.
  const Vec3 apex = bounding_box(mesh).center();
  Sum volume6;
  EntrywiseSum<Vec3> first24;
  EntrywiseSum<Mat3> second120;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 a = mesh.corner(f, 0) - apex;
    const Vec3 b = mesh.corner(f, 1) - apex;
    const Vec3 c = mesh.corner(f, 2) - apex;
    const Vec3 s = a + b + c;
    const double d = a.dot(b.cross(c));
    volume6 += d;
    first24 += Vec3(d * s);
    second120 +=
        Mat3(d * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose()));
  }

  MassProperties result;
  result.volume = volume6.value() / 6;
  result.center = apex;
  if (result.volume == 0) return result;
  const Vec3 offset = first24.value() / (24 * result.volume);
  result.center = apex + offset;
  const Mat3 second = second120.value() / 120 - result.volume * (offset * offset.transpose());
  result.inertia = second.trace() * Mat3::Identity() - second;
  return result;
}

double volume(const TriangleMesh& mesh) {
  const Vec3 apex = bounding_box(mesh).center();
  Sum volume6;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 b = mesh.corner(f, 1) - apex;
    const Vec3 c = mesh.corner(f, 2) - apex;
    volume6 += (mesh.corner(f, 0) - apex).dot(b.cross(c));
  }
  return volume6.value() / 6;
}

double area(const TriangleMesh& mesh) {
  Sum area2;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) area2 += area_vector2(mesh, f).norm();
  return area2.value() / 2;
}

Vec3 area_vector2(const TriangleMesh& mesh, std::size_t face) {
  const Vec3& a = mesh.corner(face, 0);
  return (mesh.corner(face, 1) - a).cross(mesh.corner(face, 2) - a);
}

BoundingBox bounding_box(const TriangleMesh& mesh) {
  BoundingBox box;
  if (mesh.faces.empty()) return box;
  box.low.setConstant(std::numeric_limits<double>::infinity());
  box.high = -box.low;
  for (const Face& face : mesh.faces) {
    for (const std::int32_t v : face) {
      box.low = box.low.cwiseMin(mesh.vertices[v]);
      box.high = box.high.cwiseMax(mesh.vertices[v]);
    }
  }
  return box;
}

TriangleMesh normalized(const TriangleMesh& mesh, double longest_side) {
  const BoundingBox box = bounding_box(mesh);
  const double side = box.longest_side();
  const double tolerance = 1e-6 * longest_side;
  const bool centred = box.center().cwiseAbs().maxCoeff() <= tolerance;
  if (side <= 0 || (centred && std::abs(side - longest_side) <= tolerance)) return mesh;
  TriangleMesh result = mesh;
  const Vec3 center = box.center();
  for (Vec3& vertex : result.vertices) vertex = (vertex - center) * (longest_side / side);
  return result;
}

}  // namespace fracbench
