#include "methods/bem/elastic_body.h"

#include <gtest/gtest.h>

#include "methods/bem/elastic_operator.h"
#include "methods/bem/surface_stress.h"
#include "tests/methods/bem/plain_context.h"

namespace fracbench::bem {
namespace {

Material stone() {
  Material material;
  material.young_modulus = 3e9;
  material.poisson_ratio = 0.3;
  return material;
}

Eigen::Matrix3Xd tractions_of(const BoundaryElements& elements, const Mat3& stress) {
  Eigen::Matrix3Xd tractions(3, elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) {
    tractions.col(static_cast<Eigen::Index>(k)) = stress * elements.normals[k];
  }
  return tractions;
}

TEST(ElasticBody, ACubeUnderUniformTractionsHasThatStressOnEveryTriangle) {
  PlainContext context;
  const ElasticBody body(cube_surface(4), stone(), context.get());
  Mat3 stress;
  stress << 1e6, 3e5, -2e5, 3e5, -5e5, 7e5, -2e5, 7e5, 4e5;
  const Eigen::Matrix3Xd tractions = tractions_of(body.elements(), stress);
  const Eigen::VectorXd u = body.displacements(tractions, context.get());
  for (const Mat3& computed : surface_stress(body.elements(), u, tractions, stone())) {
    EXPECT_LT((computed - stress).norm(), 1e-4 * stress.norm()) << computed;
  }
  EXPECT_LT((body.rigid_motions().transpose() * u).norm(), 1e-9 * u.norm());
}

TEST(ElasticBody, AddingAUniformPressureChangesNothingButThePressure) {
  PlainContext context;
  const ElasticBody body(cube_surface(3), stone(), context.get());
  Mat3 shear = Mat3::Zero();
  shear(0, 1) = shear(1, 0) = 1e6;
  const Mat3 pressure = -2e6 * Mat3::Identity();
  const auto stresses = [&](const Mat3& stress) {
    const Eigen::Matrix3Xd tractions = tractions_of(body.elements(), stress);
    return surface_stress(body.elements(), body.displacements(tractions, context.get()), tractions,
                          stone());
  };
  const std::vector<Mat3> one = stresses(shear);
  const std::vector<Mat3> both = stresses(shear + pressure);
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_LT((both[k] - one[k] - pressure).norm(), 1e-4 * pressure.norm());
  }
}

TEST(ElasticBody, SolvesItsOwnMatrix) {
  PlainContext context;
  const ElasticBody body(cube_surface(7), stone(), context.get());
  Eigen::MatrixXd matrix = assemble_hypersingular(body.elements(), stone(), context.get());
  matrix += matrix.trace() / static_cast<double>(matrix.rows()) * body.rigid_motions() *
            body.rigid_motions().transpose();
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(matrix.rows(), 3);
  Eigen::MatrixXd x = b;
  body.solve_in_place(x);
  EXPECT_LT((matrix * x - b).norm(), 1e-10 * b.norm());
  Eigen::MatrixXd half = b;
  body.solve_lower_in_place(half);
  EXPECT_LT((half.transpose() * half - b.transpose() * x).norm(),
            1e-10 * (b.transpose() * x).norm());
}

TEST(ElasticBody, AnOpenSurfaceIsRefused) {
  PlainContext context;
  TriangleMesh open = cube_surface(2);
  open.faces.pop_back();
  EXPECT_THROW(ElasticBody(open, stone(), context.get()), InputError);
}

TEST(ElasticBody, AMatrixLargerThanTheMemoryIsRefusedBeforeAnyWork) {
  PlainContext context;
  try {
    const ElasticBody body(cube_surface(200), stone(), context.get());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("GB"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(context.get().timer.times().empty());
}

TEST(ElasticBody, MemoryIsThatOfOneMatrixAndTimeGrowsWithTheCube) {
  EXPECT_NEAR(static_cast<double>(predict_cost(6000).bytes), 648e6, 30e6);
  EXPECT_NEAR(predict_cost(6000).factor_seconds / predict_cost(3000).factor_seconds, 8, 1e-9);
}

}  // namespace
}  // namespace fracbench::bem
