#include "methods/bem/somigliana_stress.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "methods/bem/elastic_operator.h"
#include "methods/bem/processor_clones.h"
#include "methods/bem/surface_stress.h"
#include "methods/bem/triangle_potentials.h"
#include "methods/bem/triangle_rules.h"

namespace fracbench::bem {
namespace {

constexpr double kNearRadii = 5;

constexpr int kGroupLanes = 8;
using Lanes = double __attribute__((vector_size(sizeof(double) * kGroupLanes), may_alias));

inline const Lanes& lanes(const double* values) { return *reinterpret_cast<const Lanes*>(values); }

__attribute__((always_inline)) inline void square_root(const Lanes& squared, Lanes& root) {
  alignas(64) double values[kGroupLanes];
  *reinterpret_cast<Lanes*>(values) = squared;
  for (double& value : values) value = std::sqrt(value);
  root = *reinterpret_cast<const Lanes*>(values);
}

}  // namespace

// Lane by lane, over the groups: the symmetric part of each sum in the order xx, yy, zz, xy, xz, yz
// (twice the value off the diagonal), and the solid angle.
struct SomiglianaStress::Sums {
  alignas(64) double field_kelvin[6][kLanes] = {};  ///< field x density
  alignas(64) double third[6][kLanes] = {};         ///< r r (r . density) / |r|^5
  alignas(64) double laplace[6][kLanes] = {};       ///< field x curl + shear x field
  alignas(64) double solid_angle[kLanes] = {};
};

SomiglianaStress::SomiglianaStress(const BoundaryElements& elements,
                                   const Eigen::VectorXd& displacements,
                                   const Eigen::Matrix3Xd& tractions, const Material& material)
    : elements_(elements), material_(material) {
  static_assert(kLanes == kGroupLanes);
  const double mu = shear_modulus(material);
  const std::size_t count = elements.size();
  kelvin_.resize(count);
  curl_.resize(count);
  shear_.resize(count);
  Group empty{};
  // Lanes left over count as near, and near triangles are taken from the list.
  for (double& squared : empty.near_squared) squared = std::numeric_limits<double>::max();
  groups_.assign((count + kLanes - 1) / kLanes, empty);
  for (std::size_t k = 0; k < count; ++k) {
    shear_[k].setZero();
    curl_[k].setZero();
    for (int a = 0; a < 3; ++a) {
      const Vec3 u =
          displacements.segment<3>(3 * static_cast<Eigen::Index>(elements.triangles[k][a]));
      const Vec3& s = elements.curls[k][a];
      shear_[k] += u * s.transpose();
      curl_[k] += s.cross(u);
    }
    kelvin_[k] = Vec3(tractions.col(static_cast<Eigen::Index>(k))) - 2 * mu * curl_[k];

    Group& group = groups_[k / kLanes];
    const std::size_t lane = k % kLanes;
    const Corners corners = elements.corners(k);
    int p = 0;
    for (const TrianglePoint& point : triangle_rule(3)) {
      const Vec3 y =
          corners[0] + point.u * (corners[1] - corners[0]) + point.v * (corners[2] - corners[0]);
      for (int c = 0; c < 3; ++c) group.points[3 * p + c][lane] = y[c];
      ++p;
    }
    group.near_squared[lane] = std::pow(kNearRadii * elements.radii[k], 2);
    group.third_area[lane] = elements.areas[k] / 3;
    for (int c = 0; c < 3; ++c) {
      group.centroid[c][lane] = elements.centroids[k][c];
      group.kelvin[c][lane] = kelvin_[k][c];
      group.curl[c][lane] = curl_[k][c];
      group.normal[c][lane] = elements.normals[k][c];
      for (int i = 0; i < 3; ++i) group.shear[3 * i + c][lane] = shear_[k](i, c);
    }
  }
}

FRACBENCH_PROCESSOR_CLONES("avx512f", "avx2", "default")
void SomiglianaStress::add_groups(const Group* begin, const Group* end, const Vec3& x, Sums& sums,
                                  unsigned char* near) {
  Lanes field_kelvin[6] = {};
  Lanes third[6] = {};
  Lanes laplace[6] = {};
  Lanes solid_angle = {};
  for (const Group* group = begin; group != end; ++group, near += kLanes) {
    const Lanes cx = x[0] - lanes(group->centroid[0]);
    const Lanes cy = x[1] - lanes(group->centroid[1]);
    const Lanes cz = x[2] - lanes(group->centroid[2]);
    alignas(64) double beyond[kLanes];
    *reinterpret_cast<Lanes*>(beyond) = cx * cx + cy * cy + cz * cz - lanes(group->near_squared);
    for (int l = 0; l < kLanes; ++l) {
      near[l] = beyond[l] < 0;
      beyond[l] = beyond[l] < 0 ? 0 : 1;
    }
    const Lanes far = lanes(beyond);
    const Lanes weight = far * lanes(group->third_area);
    const Lanes kx = lanes(group->kelvin[0]);
    const Lanes ky = lanes(group->kelvin[1]);
    const Lanes kz = lanes(group->kelvin[2]);
    Lanes fx = {}, fy = {}, fz = {};
    for (int p = 0; p < 3; ++p) {
      const Lanes rx = x[0] - lanes(group->points[3 * p]);
      const Lanes ry = x[1] - lanes(group->points[3 * p + 1]);
      const Lanes rz = x[2] - lanes(group->points[3 * p + 2]);
      // Near triangles get a distance that does no harm.
      const Lanes squared = far * (rx * rx + ry * ry + rz * rz) + (1 - far);
      Lanes root;
      square_root(squared, root);
      const Lanes inverse = 1 / squared;
      const Lanes cube = weight * inverse / root;
      fx += cube * rx;
      fy += cube * ry;
      fz += cube * rz;
      const Lanes fifth = cube * inverse * (rx * kx + ry * ky + rz * kz);
      const Lanes tx = fifth * rx;
      const Lanes ty = fifth * ry;
      const Lanes tz = fifth * rz;
      third[0] += tx * rx;
      third[1] += ty * ry;
      third[2] += tz * rz;
      third[3] += tx * ry;
      third[4] += tx * rz;
      third[5] += ty * rz;
    }
    field_kelvin[0] += fx * kx;
    field_kelvin[1] += fy * ky;
    field_kelvin[2] += fz * kz;
    field_kelvin[3] += fx * ky + fy * kx;
    field_kelvin[4] += fx * kz + fz * kx;
    field_kelvin[5] += fy * kz + fz * ky;
    const Lanes mx = lanes(group->curl[0]);
    const Lanes my = lanes(group->curl[1]);
    const Lanes mz = lanes(group->curl[2]);
    const double(&s)[9][kLanes] = group->shear;
    // Row i: s_i x F.
    laplace[0] += fx * mx + lanes(s[1]) * fz - lanes(s[2]) * fy;
    laplace[1] += fy * my + lanes(s[5]) * fx - lanes(s[3]) * fz;
    laplace[2] += fz * mz + lanes(s[6]) * fy - lanes(s[7]) * fx;
    laplace[3] += fx * my + fy * mx + lanes(s[2]) * fx - lanes(s[0]) * fz + lanes(s[4]) * fz -
                  lanes(s[5]) * fy;
    laplace[4] += fx * mz + fz * mx + lanes(s[0]) * fy - lanes(s[1]) * fx + lanes(s[7]) * fz -
                  lanes(s[8]) * fy;
    laplace[5] += fy * mz + fz * my + lanes(s[3]) * fy - lanes(s[4]) * fx + lanes(s[8]) * fx -
                  lanes(s[6]) * fz;
    solid_angle +=
        fx * lanes(group->normal[0]) + fy * lanes(group->normal[1]) + fz * lanes(group->normal[2]);
  }
  for (int k = 0; k < 6; ++k) {
    *reinterpret_cast<Lanes*>(sums.field_kelvin[k]) = field_kelvin[k];
    *reinterpret_cast<Lanes*>(sums.third[k]) = third[k];
    *reinterpret_cast<Lanes*>(sums.laplace[k]) = laplace[k];
  }
  *reinterpret_cast<Lanes*>(sums.solid_angle) = solid_angle;
}

SomiglianaStress::Value SomiglianaStress::at(const Vec3& x) const {
  Sums sums;
  std::vector<unsigned char> near(groups_.size() * kLanes);
  add_groups(groups_.data(), groups_.data() + groups_.size(), x, sums, near.data());
  const auto symmetric = [](const double(&values)[6][kLanes], double off_diagonal) -> Mat3 {
    std::array<double, 6> sum = {};
    for (int k = 0; k < 6; ++k) {
      for (const double value : values[k]) sum[k] += k < 3 ? value : off_diagonal * value;
    }
    Mat3 result;
    result << sum[0], sum[3], sum[4], sum[3], sum[1], sum[5], sum[4], sum[5], sum[2];
    return result;
  };
  Mat3 field_kelvin = symmetric(sums.field_kelvin, 0.5);
  Mat3 third = symmetric(sums.third, 1);
  Mat3 laplace = symmetric(sums.laplace, 0.5);
  double solid_angle = 0;
  for (const double angle : sums.solid_angle) solid_angle += angle;

  for (std::size_t k = 0; k < elements_.size(); ++k) {
    if (!near[k]) continue;
    const TrianglePotentials potentials =
        triangle_potentials(elements_.corners(k), elements_.normals[k], x, kelvin_[k]);
    const Vec3& field = potentials.field;
    field_kelvin += kelvin_[k] * field.transpose();
    third += potentials.third;
    laplace += curl_[k] * field.transpose();
    for (int i = 0; i < 3; ++i) laplace.row(i) += shear_[k].row(i).cross(field.transpose());
    solid_angle += potentials.solid_angle;
  }

  // d u_i / d x_k, up to an antisymmetric part: Kelvin's solution with the density q = t - 2 mu M
  // u, 1/r with M u, and the Laplace double layer of u as a curl.
  const double nu = material_.poisson_ratio;
  const double scale = 1 / (16 * std::numbers::pi * shear_modulus(material_) * (1 - nu));
  const Mat3 gradient =
      scale * (field_kelvin.trace() * Mat3::Identity() - (2 - 4 * nu) * field_kelvin - 3 * third) -
      laplace / (4 * std::numbers::pi);
  // solid_angle is that of r from the surface to x: negative where normals point away from x.
  return {stress_of_gradient(gradient, material_), -solid_angle / (4 * std::numbers::pi)};
}

}  // namespace fracbench::bem
