#include "methods/modes/validation/solver_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "geometry/read_mesh.h"
#include "methods/modes/cage.h"
#include "methods/modes/fracture_modes.h"
#include "methods/modes/modes_problem.h"
#include "methods/modes/validation/shapes.h"
#include "source_folder.h"
#include "tests/methods/modes/test_meshes.h"

namespace fracbench::modes {
namespace {

class Surroundings {
 public:
  Context context{.random = random_, .timer = timer_, .progress = progress_};

 private:
  Random random_{1};
  StageTimer timer_;
  Progress progress_;
};

class SolverCase : public testing::TestWithParam<ValidationCase> {};

TEST_P(SolverCase, AgreesWithItsReference) {
  Surroundings s;
  const std::vector<Accuracy> rows = GetParam().run(s.context);
  EXPECT_FALSE(rows.empty());
  for (const Accuracy& row : rows) {
    EXPECT_TRUE(row.pass()) << row.name << ": " << row.computed << " for " << row.expected;
  }
}

std::string test_name(const testing::TestParamInfo<ValidationCase>& info) {
  std::string name = info.param.name;
  std::ranges::replace(name, '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Modes, SolverCase, testing::ValuesIn(solver_validation_cases()),
                         test_name);

TEST(FractureModes, AreOrthonormalToEachOtherAndToTranslations) {
  const TetMesh mesh = test::tets_of(l_shape(), 800);
  Surroundings s;
  const FractureModes modes = compute_modes(mesh, {.count = 7}, s.context);
  const auto tets = static_cast<Eigen::Index>(mesh.tets.size());
  Eigen::VectorXd mass(3 * tets);
  for (Eigen::Index t = 0; t < tets; ++t) mass.segment<3>(3 * t).setConstant(mesh.volumes[t]);
  Eigen::MatrixXd all(3 * tets, 10);
  for (int k = 0; k < 3; ++k) {
    all.col(k).setZero();
    all.col(k)(Eigen::seqN(k, tets, 3)).setConstant(1 / std::sqrt(mesh.volume()));
  }
  all.rightCols(7) = modes.displacement;
  const Eigen::MatrixXd gram = all.transpose() * mass.asDiagonal() * all;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(10, 10)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(FractureModes, HaveTheEnergyOfTheirJumps) {
  const TetMesh mesh = test::tets_of(notched_bar(), 500);
  Surroundings s;
  const FractureModes modes = compute_modes(mesh, {.count = 4}, s.context);
  for (int m = 0; m < 4; ++m) {
    double energy = 0;
    for (const auto& face : mesh.interior_faces) {
      energy += face.area * (modes.displacement.col(m).segment<3>(3 * face.tets[0]) -
                             modes.displacement.col(m).segment<3>(3 * face.tets[1]))
                                .norm();
    }
    EXPECT_NEAR(modes.energies[m], energy, 1e-9);
    EXPECT_LE(modes.gaps[m], 1e-4);
  }
}

TEST(FractureModes, OfSeveralPartsOpenFacesWithinThem) {
  // Two bars that do not touch: moving one against the other is no mode.
  TriangleMesh shape = plain_bar();
  const TriangleMesh other = plain_bar();
  for (const Face& f : other.faces) shape.faces.push_back({f[0] + 8, f[1] + 8, f[2] + 8});
  for (const Vec3& v : other.vertices) shape.vertices.push_back(v + Vec3(0, 2, 0));
  const TetMesh mesh = test::tets_of(shape, 600);
  Surroundings s;
  const FractureModes modes = compute_modes(mesh, {.count = 2, .dimension = 1}, s.context);
  for (int m = 0; m < 2; ++m) {
    EXPECT_GE(modes.piece_counts[m], 3);
    EXPECT_GT(modes.energies[m], 0.1);
  }
}

TEST(FractureModes, AreTheSameBytesEveryTime) {
  const TetMesh mesh = test::tets_of_bar(400);
  Surroundings a, b;
  b.context.threads = 2;
  const ModesOptions options{.count = 3, .dimension = 1};
  EXPECT_EQ(compute_modes(mesh, options, a.context).displacement,
            compute_modes(mesh, options, b.context).displacement);
}

TEST(FractureModes, RefuseOptionsThatCannotBeMet) {
  const TetMesh mesh = test::tets_of_bar(300);
  Surroundings s;
  EXPECT_THROW(compute_modes(mesh, {.count = 0}, s.context), InputError);
  EXPECT_THROW(compute_modes(mesh, {.dimension = 2}, s.context), InputError);
  EXPECT_THROW(compute_modes(mesh, {.dimension = 1, .elastic = true}, s.context), InputError);
  EXPECT_THROW(compute_modes(mesh, {.count = 5000}, s.context), InputError);
  EXPECT_THROW(compute_modes(mesh, {.jump_threshold = 0}, s.context), InputError);
  Material liquid;
  liquid.poisson_ratio = 0.5;
  EXPECT_THROW(compute_modes(mesh, {.elastic = true, .material = liquid}, s.context), InputError);
}

TEST(ElasticEnergy, IsThatOfTheDisplacementsThatAreConstantInEveryTet) {
  const TetMesh mesh = test::tets_of_bar(300);
  const GroupSparseEnergy constant = constant_energy(mesh), elastic = elastic_energy(mesh, {});
  const auto tets = static_cast<Eigen::Index>(mesh.tets.size());
  const Eigen::MatrixXd u = Eigen::MatrixXd::Random(tets, 3);
  Eigen::MatrixXd v(12 * tets, 1);
  for (Eigen::Index t = 0; t < tets; ++t) {
    for (int j = 0; j < 4; ++j) v.block(12 * t + 3 * j, 0, 3, 1) = u.row(t).transpose();
  }
  EXPECT_NEAR(elastic.value(v), constant.value(u), 1e-9 * constant.value(u));
}

TEST(ElasticEnergy, OfAUniformStrainIsThatOfHookesLaw) {
  const TetMesh mesh = test::tets_of_bar(300);
  const ElasticScale scale;
  const GroupSparseEnergy energy = elastic_energy(mesh, scale);
  Mat3 gradient;
  gradient << 0.1, 0.3, -0.2, 0.05, -0.4, 0.1, 0.2, 0.6, 0.3;
  Eigen::MatrixXd u(energy.size(), 1);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int j = 0; j < 4; ++j) {
      u.block(12 * t + 3 * j, 0, 3, 1) = gradient * mesh.vertices[mesh.tets[t][j]];
    }
  }
  const Mat3 strain = (gradient + gradient.transpose()) / 2;
  const double nu = scale.material.poisson_ratio;
  const double lambda = nu / ((1 + nu) * (1 - 2 * nu)), mu = 1 / (2 * (1 + nu));
  const double stiffness = scale.material.young_modulus * scale.opening / scale.material.strength;
  const double expected = stiffness * mesh.volume() / 2 *
                          (lambda * std::pow(strain.trace(), 2) + 2 * mu * strain.squaredNorm());
  EXPECT_NEAR(energy.value(u), expected, 1e-9 * expected);
  EXPECT_LT((energy.quadratic * energy.kernel).norm() + (energy.jump * energy.kernel).norm(), 1e-8);
}

TEST(FractureModes, OfTheBunnyHaveThePiecesOfTheReferenceTable) {
  const auto file = std::filesystem::path(FRACBENCH_SOURCE_DIR) / "../shared/meshes/bunny.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  Surroundings s;
  const TetMesh mesh = tetrahedralise_cage(read_mesh(file), {.target_faces = 900}, s.context);
  const FractureModes modes = compute_modes(mesh, {.count = 6}, s.context);
  EXPECT_EQ(modes.piece_counts, (std::vector<std::int32_t>{2, 2, 2, 3, 3, 3}));
}

}  // namespace
}  // namespace fracbench::modes
