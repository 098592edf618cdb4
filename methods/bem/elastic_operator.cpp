#include "methods/bem/elastic_operator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/parallel.h"
#include "methods/bem/galerkin_integrals.h"
#include "methods/bem/processor_clones.h"

namespace fracbench::bem {
namespace {

// Test triangles are taken in strips: first the integrals of the strip against all trial triangles
// (in parallel over the strip's triangles), then their sums into the columns of the matrix (in
// parallel over the trial vertices, each of which owns its columns). No sum depends on the threads.
constexpr std::size_t kStrip = 32;

// A strip's integrals: for each trial triangle and component the values of all strip triangles.
using StripValues = std::array<double, kStrip>;
using StripTable = std::vector<std::array<StripValues, kPairComponents>>;

// Per trial vertex and strip triangle, sums over the triangles around the vertex with its surface
// curl s: of K (s x e_q) in column q, and of G s, G being the integral of 1/r.
struct CurlSums {
  std::array<StripValues, 9> stress;  // 3 p + q
  std::array<StripValues, 3> shear;
};

// K = mu / (4 pi (1 - nu)) ((2 nu - 1) G - R), R being the integral of r r^T / r^3.
FRACBENCH_PROCESSOR_CLONES("avx2", "default")
void add_curl(const std::array<StripValues, kPairComponents>& table, const Vec3& s, double nu,
              CurlSums& sums) {
  for (std::size_t t = 0; t < kStrip; ++t) {
    const double g = table[0][t] + table[1][t] + table[2][t];
    const double isotropic = (2 * nu - 1) * g;
    const double xx = isotropic - table[0][t];
    const double yy = isotropic - table[1][t];
    const double zz = isotropic - table[2][t];
    const double xy = -table[3][t];
    const double xz = -table[4][t];
    const double yz = -table[5][t];
    // s x e_0 = (0, s2, -s1), s x e_1 = (-s2, 0, s0), s x e_2 = (s1, -s0, 0).
    sums.stress[0][t] += xy * s[2] - xz * s[1];
    sums.stress[1][t] += xz * s[0] - xx * s[2];
    sums.stress[2][t] += xx * s[1] - xy * s[0];
    sums.stress[3][t] += yy * s[2] - yz * s[1];
    sums.stress[4][t] += yz * s[0] - xy * s[2];
    sums.stress[5][t] += xy * s[1] - yy * s[0];
    sums.stress[6][t] += yz * s[2] - zz * s[1];
    sums.stress[7][t] += zz * s[0] - xz * s[2];
    sums.stress[8][t] += xz * s[1] - yz * s[0];
    sums.shear[0][t] += g * s[0];
    sums.shear[1][t] += g * s[1];
    sums.shear[2][t] += g * s[2];
  }
}

// Adds the sums of one trial vertex to its three columns.
void scatter(const BoundaryElements& test, std::size_t begin, std::size_t end, const CurlSums& sums,
             const Material& material, std::size_t column, Eigen::MatrixXd& matrix) {
  const double nu = material.poisson_ratio;
  const double scale = shear_modulus(material) / (4 * std::numbers::pi);
  for (std::size_t triangle = begin; triangle < end; ++triangle) {
    const std::size_t t = triangle - begin;
    Mat3 stress;  // column q: K (s x e_q)
    for (int k = 0; k < 9; ++k) stress(k / 3, k % 3) = sums.stress[k][t];
    stress *= scale / (1 - nu);
    const Vec3 shear = scale * Vec3(sums.shear[0][t], sums.shear[1][t], sums.shear[2][t]);
    for (int a = 0; a < 3; ++a) {
      const Vec3& curl = test.curls[triangle][a];
      Mat3 block = -curl * shear.transpose();
      block.diagonal().array() += 2 * curl.dot(shear);
      for (int q = 0; q < 3; ++q) block.col(q) += stress.col(q).cross(curl);
      matrix.block<3, 3>(3 * static_cast<Eigen::Index>(test.triangles[triangle][a]),
                         3 * static_cast<Eigen::Index>(column)) += block;
    }
  }
}

// Sums all pairs (symmetric: each pair once, a triangle with itself by half, so that the operator
// is the result plus its transpose).
Eigen::MatrixXd assemble(const BoundaryElements& test, const BoundaryElements& trial,
                         bool symmetric, const Material& material, const Context& context) {
  check_elastic_material(material);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(test.unknowns()),
                                                 static_cast<Eigen::Index>(trial.unknowns()));
  const std::vector<std::vector<std::int32_t>> around = triangles_around_vertices(trial);
  StripTable table(trial.size());
  for (std::size_t begin = 0; begin < test.size(); begin += kStrip) {
    context.stop_if_asked();
    const std::size_t end = std::min(begin + kStrip, test.size());
    const std::size_t first_trial = symmetric ? begin : 0;
    for (std::size_t k = first_trial; k < trial.size(); ++k) {
      for (StripValues& values : table[k]) values.fill(0);
    }
    parallel_for(end - begin, context.threads, [&](std::size_t t) {
      const std::size_t own_first = symmetric ? begin + t : 0;
      std::vector<std::int32_t> indices(trial.size() - own_first);
      for (std::size_t k = 0; k < indices.size(); ++k) {
        indices[k] = static_cast<std::int32_t>(own_first + k);
      }
      std::vector<PairIntegrals> row(indices.size());
      PairIntegrator(false).integrate(test, begin + t, trial, indices, row);
      for (std::size_t k = 0; k < row.size(); ++k) {
        const double share = symmetric && k == 0 ? 0.5 : 1;
        for (int c = 0; c < kPairComponents; ++c) {
          table[own_first + k][c][t] = share * row[k].values[c];
        }
      }
    });
    parallel_for(
        around.size(), context.threads,
        [&](std::size_t vertex) {
          CurlSums sums = {};
          bool any = false;
          for (const std::int32_t triangle : around[vertex]) {
            if (static_cast<std::size_t>(triangle) < first_trial) continue;
            any = true;
            const Face& face = trial.triangles[triangle];
            for (int b = 0; b < 3; ++b) {
              if (static_cast<std::size_t>(face[b]) == vertex) {
                add_curl(table[triangle], trial.curls[triangle][b], material.poisson_ratio, sums);
              }
            }
          }
          if (any) scatter(test, begin, end, sums, material, vertex, matrix);
        },
        16);
  }
  return matrix;
}

}  // namespace

void check_elastic_material(const Material& material) {
  const auto refuse = [](std::string_view name, double value, std::string_view range) {
    throw InputError(
        fmt::format("{} = {} is outside the physical range: give {}", name, value, range));
  };
  if (!(material.young_modulus > 0) || !std::isfinite(material.young_modulus)) {
    refuse("young_modulus", material.young_modulus, "a number above 0, Pa");
  }
  if (!(material.poisson_ratio > -1 && material.poisson_ratio < 0.5)) {
    refuse("poisson_ratio", material.poisson_ratio, "a number above -1 and below 0.5");
  }
  if (!(material.density > 0) || !std::isfinite(material.density)) {
    refuse("density", material.density, "a number above 0, kg/m^3");
  }
}

double shear_modulus(const Material& material) {
  return material.young_modulus / (2 * (1 + material.poisson_ratio));
}

Eigen::MatrixXd assemble_hypersingular(const BoundaryElements& test, const BoundaryElements& trial,
                                       const Material& material, const Context& context) {
  return assemble(test, trial, false, material, context);
}

Eigen::MatrixXd assemble_hypersingular(const BoundaryElements& elements, const Material& material,
                                       const Context& context) {
  Eigen::MatrixXd matrix = assemble(elements, elements, true, material, context);
  // In tiles, so that the transposed access stays in the cache.
  constexpr Eigen::Index kTile = 64;
  const Eigen::Index n = matrix.rows();
  const auto tiles = static_cast<std::size_t>((n + kTile - 1) / kTile);
  parallel_for(tiles, context.threads, [&](std::size_t tile) {
    const Eigen::Index first = static_cast<Eigen::Index>(tile) * kTile;
    const Eigen::Index last = std::min(first + kTile, n);
    for (Eigen::Index other = 0; other <= first; other += kTile) {
      for (Eigen::Index j = other; j < std::min(other + kTile, last); ++j) {
        for (Eigen::Index i = std::max(first, j); i < last; ++i) {
          matrix(i, j) += matrix(j, i);
          matrix(j, i) = matrix(i, j);
        }
      }
    }
  });
  return matrix;
}

Eigen::VectorXd apply_adjoint_double_layer(const BoundaryElements& source,
                                           const Eigen::Matrix3Xd& tractions,
                                           const BoundaryElements& target, const Material& material,
                                           const Context& context) {
  check_elastic_material(material);
  std::vector<std::int32_t> loaded;
  for (std::size_t k = 0; k < source.size(); ++k) {
    if (!tractions.col(static_cast<Eigen::Index>(k)).isZero(0)) {
      loaded.push_back(static_cast<std::int32_t>(k));
    }
  }
  const double nu = material.poisson_ratio;
  const double laplace = 1 / (4 * std::numbers::pi);
  // 2 mu U = ((3 - 4 nu) G + R) / (8 pi (1 - nu)).
  const double kelvin = 1 / (8 * std::numbers::pi * (1 - nu));

  // Per target triangle: what the tractions give to its curls and to its hat functions. Strips of
  // loaded triangles, as in the assembly.
  struct Share {
    Vec3 curl = Vec3::Zero();
    std::array<Vec3, 3> hats = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  };
  std::vector<Share> shares(target.size());
  std::vector<std::int32_t> all(target.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<PairIntegrals>> rows(kStrip);
  for (std::size_t begin = 0; begin < loaded.size(); begin += kStrip) {
    context.stop_if_asked();
    const std::size_t count = std::min(kStrip, loaded.size() - begin);
    parallel_for(count, context.threads, [&](std::size_t k) {
      rows[k].resize(target.size());
      PairIntegrator(true).integrate(source, loaded[begin + k], target, all, rows[k]);
    });
    parallel_for(
        target.size(), context.threads,
        [&](std::size_t triangle) {
          Share& share = shares[triangle];
          for (std::size_t k = 0; k < count; ++k) {
            const Vec3 t = tractions.col(loaded[begin + k]);
            const auto& v = rows[k][triangle].values;
            const Vec3 projected(v[0] * t.x() + v[3] * t.y() + v[4] * t.z(),
                                 v[3] * t.x() + v[1] * t.y() + v[5] * t.z(),
                                 v[4] * t.x() + v[5] * t.y() + v[2] * t.z());
            const double g = rows[k][triangle].inverse_distance();
            share.curl += (kelvin * (3 - 4 * nu) - laplace) * g * t + kelvin * projected;
            for (int b = 0; b < 3; ++b) share.hats[b] += laplace * v[6 + b] * t;
          }
        },
        64);
  }
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(target.unknowns()));
  for (std::size_t triangle = 0; triangle < target.size(); ++triangle) {
    const Share& share = shares[triangle];
    for (int b = 0; b < 3; ++b) {
      // (s x e_q) . w = (w x s)_q
      result.segment<3>(3 * static_cast<Eigen::Index>(target.triangles[triangle][b])) +=
          share.hats[b] + share.curl.cross(target.curls[triangle][b]);
    }
  }
  return result;
}

Eigen::VectorXd traction_moments(const BoundaryElements& elements,
                                 const Eigen::Matrix3Xd& tractions) {
  Eigen::VectorXd moments = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(elements.unknowns()));
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const Vec3 third = elements.areas[k] / 3 * tractions.col(static_cast<Eigen::Index>(k));
    for (const std::int32_t v : elements.triangles[k]) {
      moments.segment<3>(3 * static_cast<Eigen::Index>(v)) += third;
    }
  }
  return moments;
}

}  // namespace fracbench::bem
