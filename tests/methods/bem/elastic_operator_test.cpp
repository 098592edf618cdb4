#include "methods/bem/elastic_operator.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/methods/bem/plain_context.h"

namespace fracbench::bem {
namespace {

Material rubber() {
  Material material;
  material.young_modulus = 2.5;
  material.poisson_ratio = 0.3;
  return material;
}

Eigen::VectorXd field(const BoundaryElements& elements, const auto& displacement) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(elements.unknowns()));
  for (std::size_t v = 0; v < elements.vertices.size(); ++v) {
    values.segment<3>(3 * static_cast<Eigen::Index>(v)) = displacement(elements.vertices[v]);
  }
  return values;
}

Eigen::Matrix3Xd tractions_of(const BoundaryElements& elements, const Mat3& stress) {
  Eigen::Matrix3Xd tractions(3, elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) {
    tractions.col(static_cast<Eigen::Index>(k)) = stress * elements.normals[k];
  }
  return tractions;
}

TEST(ElasticOperator, RigidMotionsTakeNoForce) {
  PlainContext context;
  const BoundaryElements cube = make_boundary_elements(cube_surface(4));
  const Eigen::MatrixXd matrix = assemble_hypersingular(cube, rubber(), context.get());
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(k);
    const Eigen::VectorXd shift = field(cube, [&](const Vec3&) { return axis; });
    EXPECT_LT((matrix * shift).norm(), 1e-13 * matrix.norm() * shift.norm());
    const Eigen::VectorXd turn = field(cube, [&](const Vec3& x) -> Vec3 { return axis.cross(x); });
    EXPECT_LT((matrix * turn).norm(), 1e-6 * matrix.norm() * turn.norm());
  }
}

TEST(ElasticOperator, FieldsOfUniformStressFulfilTheBoundaryIntegralEquation) {
  PlainContext context;
  const Material material = rubber();
  const BoundaryElements cube = make_boundary_elements(cube_surface(4));
  const Eigen::MatrixXd matrix = assemble_hypersingular(cube, material, context.get());
  Mat3 stress;
  stress << 1, 0.3, -0.2, 0.3, -0.5, 0.7, -0.2, 0.7, 0.4;
  const Mat3 strain = ((1 + material.poisson_ratio) * stress -
                       material.poisson_ratio * stress.trace() * Mat3::Identity()) /
                      material.young_modulus;
  const Eigen::VectorXd u = field(cube, [&](const Vec3& x) -> Vec3 { return strain * x; });
  const Eigen::Matrix3Xd tractions = tractions_of(cube, stress);
  const Eigen::VectorXd load =
      0.5 * traction_moments(cube, tractions) -
      apply_adjoint_double_layer(cube, tractions, cube, material, context.get());
  EXPECT_LT((matrix * u - load).norm(), 5e-6 * load.norm());
}

TEST(ElasticOperator, SymmetricAssemblyGivesTheSameAsTheGeneralOne) {
  PlainContext context;
  const BoundaryElements cube = make_boundary_elements(cube_surface(3));
  const Eigen::MatrixXd half = assemble_hypersingular(cube, rubber(), context.get());
  const Eigen::MatrixXd full = assemble_hypersingular(cube, cube, rubber(), context.get());
  EXPECT_EQ(half, half.transpose());
  EXPECT_LT((half - full).norm(), 5e-6 * full.norm());
}

TEST(ElasticOperator, BytesDoNotDependOnTheThreads) {
  PlainContext one(1);
  PlainContext two(2);
  const BoundaryElements cube = make_boundary_elements(cube_surface(3));
  EXPECT_EQ(assemble_hypersingular(cube, rubber(), one.get()),
            assemble_hypersingular(cube, rubber(), two.get()));
  Mat3 stress = Mat3::Identity();
  stress(0, 1) = 2;
  const Eigen::Matrix3Xd tractions = tractions_of(cube, stress);
  EXPECT_EQ(apply_adjoint_double_layer(cube, tractions, cube, rubber(), one.get()),
            apply_adjoint_double_layer(cube, tractions, cube, rubber(), two.get()));
}

// A sheet inside a body under uniform stress: the body's tractions and displacements together give
// that stress on the sheet.
TEST(ElasticOperator, ASheetInsideALoadedBodyFeelsItsStress) {
  PlainContext context;
  const Material material = rubber();
  const BoundaryElements cube = make_boundary_elements(cube_surface(4));
  const BoundaryElements sheet = make_boundary_elements(
      {{{0.3, 0.3, 0.45}, {0.7, 0.35, 0.5}, {0.6, 0.7, 0.4}, {0.3, 0.6, 0.55}, {0.5, 0.5, 0.5}},
       {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}});
  Mat3 stress;
  stress << 1, 0.3, -0.2, 0.3, -0.5, 0.7, -0.2, 0.7, 0.4;
  const Mat3 strain = ((1 + material.poisson_ratio) * stress -
                       material.poisson_ratio * stress.trace() * Mat3::Identity()) /
                      material.young_modulus;
  const Eigen::VectorXd u = field(cube, [&](const Vec3& x) -> Vec3 { return strain * x; });
  const Eigen::VectorXd felt =
      apply_adjoint_double_layer(cube, tractions_of(cube, stress), sheet, material, context.get()) +
      assemble_hypersingular(sheet, cube, material, context.get()) * u;
  // For the vertex inside the sheet: hat functions that do not vanish on the rim leave line terms.
  const Vec3 expected = traction_moments(sheet, tractions_of(sheet, stress)).segment<3>(12);
  EXPECT_LT((felt.segment<3>(12) - expected).norm(), 1e-5 * expected.norm());
}

TEST(ElasticOperator, MaterialsThatCannotBeAreRefusedByName) {
  Material material = rubber();
  material.poisson_ratio = 0.5;
  EXPECT_THROW(check_elastic_material(material), InputError);
  material = rubber();
  material.young_modulus = 0;
  EXPECT_THROW(check_elastic_material(material), InputError);
  material = rubber();
  material.density = std::numeric_limits<double>::quiet_NaN();
  try {
    check_elastic_material(material);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("density"), std::string::npos) << error.what();
  }
}

TEST(ElasticOperator, ATriangleWithoutAreaIsRefused) {
  EXPECT_THROW(make_boundary_elements({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}}),
               InputError);
}

}  // namespace
}  // namespace fracbench::bem
