#include "methods/modes/modes_problem.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "methods/modes/join.h"

namespace fracbench::modes {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Triplets = std::vector<Eigen::Triplet<double>>;

Vec3 centroid(const TetMesh& mesh, std::int32_t tet) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t v : mesh.tets[tet]) sum += mesh.vertices[v];
  return sum / 4;
}

/// What a face's jump is multiplied with in D, so that D^T D is a finite-volume Laplacian.
double jump_scale(const TetMesh& mesh, const TetMesh::InteriorFace& face) {
  return std::sqrt(face.area /
                   (centroid(mesh, face.tets[1]) - centroid(mesh, face.tets[0])).norm());
}

int corner_of(const Tet& tet, std::int32_t vertex) {
  return static_cast<int>(std::ranges::find(tet, vertex) - tet.begin());
}

struct Stiffness {
  double lambda, mu;  ///< over Young's modulus
};

Stiffness stiffness(const Material& material) {
  const double nu = material.poisson_ratio;
  return {nu / ((1 + nu) * (1 - 2 * nu)), 1 / (2 * (1 + nu))};
}

double strain_scale(const ElasticScale& scale) {
  return scale.material.young_modulus * scale.opening / scale.material.strength;
}

/// The gradients of the four barycentric coordinates, as columns.
Eigen::Matrix<double, 3, 4> gradients(const TetMesh& mesh, std::int32_t t) {
  const Tet& tet = mesh.tets[t];
  Mat3 edges;
  for (int k = 0; k < 3; ++k) {
    edges.col(k) = mesh.vertices[tet[k + 1]] - mesh.vertices[tet[0]];
  }
  Eigen::Matrix<double, 3, 4> result;
  result.rightCols<3>() = edges.inverse().transpose();
  result.col(0) = -result.rightCols<3>().rowwise().sum();
  return result;
}

void add_strain_energy(const TetMesh& mesh, std::int32_t t, const Stiffness& stiff, double factor,
                       Triplets& entries) {
  const auto g = gradients(mesh, t);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const Mat3 block = mesh.volumes[t] * factor *
                         (stiff.lambda * g.col(i) * g.col(j).transpose() +
                          stiff.mu * (g.col(j) * g.col(i).transpose() +
                                      g.col(i).dot(g.col(j)) * Mat3::Identity()));
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          entries.emplace_back(12 * t + 3 * i + a, 12 * t + 3 * j + b, block(a, b));
        }
      }
    }
  }
}

/// Rigid motions of every part, M-orthonormal, and rows that fix them.
void add_rigid_motions(const TetMesh& mesh, GroupSparseEnergy& energy) {
  const std::vector<std::int32_t> part = connected_parts(mesh);
  const int parts = part.empty() ? 0 : *std::ranges::max_element(part) + 1;
  energy.kernel = MatrixXd::Zero(energy.size(), 6 * parts);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int j = 0; j < 4; ++j) {
      const Vec3& x = mesh.vertices[mesh.tets[t][j]];
      auto rows = energy.kernel.block(12 * t + 3 * j, 6 * part[t], 3, 6);
      rows.leftCols<3>() = Mat3::Identity();
      for (int k = 0; k < 3; ++k) rows.col(3 + k) = Vec3::Unit(k).cross(x);
    }
  }
  const MatrixXd gram = energy.kernel.transpose() * (energy.mass * energy.kernel);
  // kernel <- kernel * R^-1 with gram = R^T R.
  energy.kernel = gram.llt().matrixU().solve<Eigen::OnTheRight>(energy.kernel);
  for (int p = 0; p < parts; ++p) {
    const auto first = std::ranges::find(part, p) - part.begin();
    const MatrixXd rows = energy.kernel.block(12 * first, 6 * p, 12, 6);
    const Eigen::ColPivHouseholderQR<MatrixXd> pivots(rows.transpose());
    for (int k = 0; k < 6; ++k) {
      energy.grounded.push_back(
          static_cast<std::int32_t>(12 * first + pivots.colsPermutation().indices()[k]));
    }
  }
}

}  // namespace

std::vector<std::int32_t> connected_parts(const TetMesh& mesh) {
  Joined joined(std::ssize(mesh.tets));
  for (const auto& face : mesh.interior_faces) joined.join(face.tets[0], face.tets[1]);
  return joined.labels();
}

GroupSparseEnergy constant_energy(const TetMesh& mesh) {
  const auto tets = static_cast<std::int32_t>(mesh.tets.size());
  const auto faces = static_cast<std::int32_t>(mesh.interior_faces.size());
  GroupSparseEnergy energy;
  energy.weights.resize(faces);
  Triplets jump, mass;
  for (std::int32_t f = 0; f < faces; ++f) {
    const auto& face = mesh.interior_faces[f];
    const double scale = jump_scale(mesh, face);
    energy.weights[f] = face.area / scale;
    jump.emplace_back(f, face.tets[0], scale);
    jump.emplace_back(f, face.tets[1], -scale);
    energy.joins.push_back(face.tets);
  }
  for (std::int32_t t = 0; t < tets; ++t) mass.emplace_back(t, t, mesh.volumes[t]);
  energy.jump.resize(faces, tets);
  energy.jump.setFromTriplets(jump.begin(), jump.end());
  energy.mass.resize(tets, tets);
  energy.mass.setFromTriplets(mass.begin(), mass.end());
  energy.quadratic.resize(tets, tets);

  const std::vector<std::int32_t> part = connected_parts(mesh);
  const int parts = part.empty() ? 0 : *std::ranges::max_element(part) + 1;
  energy.kernel = MatrixXd::Zero(tets, parts);
  VectorXd volume = VectorXd::Zero(parts);
  for (std::int32_t t = 0; t < tets; ++t) volume[part[t]] += mesh.volumes[t];
  for (std::int32_t t = 0; t < tets; ++t) {
    energy.kernel(t, part[t]) = 1 / std::sqrt(volume[part[t]]);
  }
  for (int p = 0; p < parts; ++p) {
    energy.grounded.push_back(static_cast<std::int32_t>(std::ranges::find(part, p) - part.begin()));
  }
  return energy;
}

GroupSparseEnergy elastic_energy(const TetMesh& mesh, const ElasticScale& scale) {
  const auto tets = static_cast<std::int32_t>(mesh.tets.size());
  const auto faces = static_cast<std::int32_t>(mesh.interior_faces.size());
  GroupSparseEnergy energy;
  energy.group_rows = 9;
  energy.weights.resize(faces);
  Triplets jump, mass, quadratic;

  // The integral over a triangle of the product of two linear functions is area times this matrix
  // between their corner values; R^T R is its Cholesky factorisation.
  const Mat3 corners = (Mat3::Ones() + Mat3::Identity()) / 12;
  const Mat3 root = corners.llt().matrixU();
  for (std::int32_t f = 0; f < faces; ++f) {
    const auto& face = mesh.interior_faces[f];
    const double s = jump_scale(mesh, face);
    energy.weights[f] = face.area / s;
    for (int side = 0; side < 2; ++side) {
      const std::int32_t t = face.tets[side];
      for (int j = 0; j < 3; ++j) {
        const int corner = corner_of(mesh.tets[t], face.corners[j]);
        for (int i = 0; i <= j; ++i) {
          for (int k = 0; k < 3; ++k) {
            jump.emplace_back(9 * f + 3 * i + k, 12 * t + 3 * corner + k,
                              (side == 0 ? s : -s) * root(i, j));
          }
        }
      }
    }
  }
  const Stiffness stiff = stiffness(scale.material);
  for (std::int32_t t = 0; t < tets; ++t) {
    add_strain_energy(mesh, t, stiff, strain_scale(scale), quadratic);
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        for (int k = 0; k < 3; ++k) {
          mass.emplace_back(12 * t + 3 * i + k, 12 * t + 3 * j + k,
                            mesh.volumes[t] / 20 * (i == j ? 2 : 1));
        }
      }
    }
  }
  energy.jump.resize(9 * faces, 12 * tets);
  energy.jump.setFromTriplets(jump.begin(), jump.end());
  energy.mass.resize(12 * tets, 12 * tets);
  energy.mass.setFromTriplets(mass.begin(), mass.end());
  energy.quadratic.resize(12 * tets, 12 * tets);
  energy.quadratic.setFromTriplets(quadratic.begin(), quadratic.end());
  add_rigid_motions(mesh, energy);
  return energy;
}

double matching_penalty(const ElasticScale& scale) {
  const Stiffness stiff = stiffness(scale.material);
  return strain_scale(scale) * (stiff.lambda + 2 * stiff.mu);
}

}  // namespace fracbench::modes
