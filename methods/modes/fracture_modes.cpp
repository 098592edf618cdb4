#include "methods/modes/fracture_modes.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "methods/modes/group_sparse_admm.h"
#include "methods/modes/join.h"
#include "methods/modes/modes_problem.h"
#include "methods/modes/smoothest_fields.h"

namespace fracbench::modes {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The first problems of the outer iteration only have to move c the right way.
constexpr double kLooseGap = 1e-3;
// They end where c changes by less than this, relative to its largest value.
constexpr double kLooseChange = 1e-2;
// A start that has less of its norm left after what earlier modes have of it is taken out of it
// would be little more than rounding.
constexpr double kLeastRemainder = 0.1;
// Starts beyond the number of modes, for those that are passed over.
constexpr int kSpareStarts = 4;

void check(const TetMesh& mesh, const ModesOptions& options) {
  const auto wrong = [](std::string_view name, auto value, std::string_view range) {
    throw InputError(fmt::format("modes: {} is {}, but must be {}", name, value, range));
  };
  if (options.count < 1) wrong("count", options.count, "at least 1");
  if (options.dimension != 1 && options.dimension != 3) {
    wrong("dimension", options.dimension, "1 or 3");
  }
  if (options.elastic && options.dimension != 3) {
    wrong("dimension", options.dimension, "3 for elastic modes");
  }
  if (!(options.jump_threshold > 0)) {
    wrong("jump_threshold", options.jump_threshold, "above 0");
  }
  if (options.iterations < 1) wrong("iterations", options.iterations, "at least 1");
  if (!(options.iteration_tolerance > 0)) {
    wrong("iteration_tolerance", options.iteration_tolerance, "above 0");
  }
  if (!(options.gap_tolerance > 0)) wrong("gap_tolerance", options.gap_tolerance, "above 0");
  if (!(options.residual_tolerance > 0)) {
    wrong("residual_tolerance", options.residual_tolerance, "above 0");
  }
  if (options.elastic) {
    const Material& m = options.material;
    if (!(m.young_modulus > 0)) wrong("young_modulus", m.young_modulus, "above 0 Pa");
    if (!(m.strength > 0)) wrong("strength", m.strength, "above 0 Pa");
    if (!(m.poisson_ratio > -1 && m.poisson_ratio < 0.5)) {
      wrong("poisson_ratio", m.poisson_ratio, "between -1 and 0.5");
    }
    if (!(options.opening > 0)) wrong("opening", options.opening, "above 0");
  }
  const int fields =
      options.elastic ? options.count : (options.count + options.dimension - 1) / options.dimension;
  const auto values = static_cast<int>(mesh.tets.size()) * (options.elastic ? 12 : 1);
  if (values < fields + 2) {
    throw InputError(
        fmt::format("modes: {} modes need more than the {} tets of this mesh; ask for "
                    "fewer modes or more tets",
                    options.count, mesh.tets.size()));
  }
}

struct Mode {
  VectorXd field;
  double energy = 0;
  double gap = 0;
  int iterations = 0;
};

/// The outer iteration on one energy with one component.
class ModeFinder {
 public:
  ModeFinder(const GroupSparseEnergy& energy, double penalty, const ModesOptions& options,
             int count, Context& context)
      : energy_(energy),
        options_(options),
        context_(context),
        solver_(energy, 1),
        found_(energy.size(), 0) {
    const auto stage = context.timer.stage("start fields");
    const auto available =
        static_cast<int>(energy.size() - energy.kernel.cols()) - 1;  // Lanczos: fewer than size
    starts_ = smoothest_fields(energy, solver_, std::min(count + kSpareStarts, available), penalty);
  }

  Mode next() {
    const auto stage = context_.timer.stage("modes");
    Mode mode;
    mode.field = next_start();
    AdmmState state;
    bool loose = true;
    while (mode.iterations < options_.iterations) {
      ++mode.iterations;
      if (mode.iterations == options_.iterations) loose = false;
      const AdmmOptions admm{.residual_tolerance = options_.residual_tolerance,
                             .gap_tolerance = loose ? std::max(kLooseGap, options_.gap_tolerance)
                                                    : options_.gap_tolerance};
      AdmmResult result = solver_.minimise(energy_.mass * mode.field, admm, state, context_);
      VectorXd c = normalised(orthogonal(std::move(result.u)));
      const double change = (c - mode.field).cwiseAbs().maxCoeff();
      mode.field = std::move(c);
      mode.gap = result.gap();
      if (!loose && change <= options_.iteration_tolerance) break;
      if (change <= kLooseChange * mode.field.cwiseAbs().maxCoeff()) loose = false;
    }
    settle_sign(mode.field);
    mode.energy = energy_.value(mode.field);
    found_.conservativeResize(Eigen::NoChange, found_.cols() + 1);
    found_.rightCols(1) = mode.field;
    solver_.add_orthogonal(energy_.mass * mode.field);
    return mode;
  }

 private:
  double mass_norm(const VectorXd& u) const { return std::sqrt(u.dot(energy_.mass * u)); }
  VectorXd normalised(const VectorXd& u) const { return u / mass_norm(u); }

  /// M-orthogonal to the kernel and the modes so far; twice, since once leaves rounding.
  VectorXd orthogonal(VectorXd u) const {
    for (int pass = 0; pass < 2; ++pass) {
      u -= found_ * (found_.transpose() * (energy_.mass * u));
      u -= energy_.kernel * (energy_.kernel.transpose() * (energy_.mass * u));
    }
    return u;
  }

  VectorXd next_start() {
    while (start_ < starts_.cols()) {
      const VectorXd start = orthogonal(starts_.col(start_++));
      if (mass_norm(start) > kLeastRemainder) return normalised(start);
    }
    throw MethodFailure(
        fmt::format("no start is left for mode {}: the earlier modes hold all {} "
                    "smooth fields; ask for fewer modes or more tets",
                    found_.cols() + 1, starts_.cols()));
  }

  /// A field and its negative are one mode: the largest value is taken positive.
  static void settle_sign(VectorXd& u) {
    Eigen::Index largest = 0;
    u.cwiseAbs().maxCoeff(&largest);
    if (u[largest] < 0) u = -u;
  }

  const GroupSparseEnergy& energy_;
  const ModesOptions& options_;
  Context& context_;
  GroupSparseSolver solver_;
  MatrixXd starts_;
  Eigen::Index start_ = 0;
  MatrixXd found_;  ///< modes so far, as columns
};

/// Root mean square over a face of the jump of an elastic field.
double elastic_jump(const TetMesh& mesh, const TetMesh::InteriorFace& face, const VectorXd& u) {
  Mat3 jump;
  for (int j = 0; j < 3; ++j) {
    Vec3 side[2];
    for (int s = 0; s < 2; ++s) {
      const std::int32_t t = face.tets[s];
      const auto corner = std::ranges::find(mesh.tets[t], face.corners[j]) - mesh.tets[t].begin();
      side[s] = u.segment<3>(12 * t + 3 * corner);
    }
    jump.col(j) = side[0] - side[1];
  }
  return std::sqrt((jump.squaredNorm() + jump.rowwise().sum().squaredNorm()) / 12);
}

template <typename Jump>
std::vector<std::int32_t> joined_below(const TetMesh& mesh, double threshold, const Jump& jump) {
  Joined joined(std::ssize(mesh.tets));
  for (const auto& face : mesh.interior_faces) {
    if (jump(face) < threshold) joined.join(face.tets[0], face.tets[1]);
  }
  return joined.labels();
}

void add_pieces(FractureModes& modes, std::vector<std::int32_t> pieces) {
  modes.piece_counts.push_back(*std::ranges::max_element(pieces) + 1);
  modes.pieces.push_back(std::move(pieces));
}

void add_facts(FractureModes& modes, const Mode& mode) {
  modes.energies.push_back(mode.energy);
  modes.iterations.push_back(mode.iterations);
  modes.gaps.push_back(mode.gap);
}

FractureModes constant_modes(const TetMesh& mesh, const ModesOptions& options, Context& context) {
  const int d = options.dimension;
  const auto tets = static_cast<Eigen::Index>(mesh.tets.size());
  const GroupSparseEnergy energy = constant_energy(mesh);
  ModeFinder finder(energy, 1, options, (options.count + d - 1) / d, context);
  FractureModes modes;
  modes.dimension = d;
  modes.displacement = MatrixXd::Zero(d * tets, options.count);
  Mode mode;
  for (int m = 0; m < options.count; ++m) {
    context.progress.update("modes", static_cast<double>(m) / options.count);
    if (m % d == 0) mode = finder.next();
    modes.displacement(Eigen::seqN(m % d, tets, d), m) = mode.field;
    add_facts(modes, mode);
    add_pieces(modes, pieces_of(mesh, modes.displacement.col(m), d, options.jump_threshold));
  }
  return modes;
}

FractureModes elastic_modes(const TetMesh& mesh, const ModesOptions& options, Context& context) {
  const auto tets = static_cast<Eigen::Index>(mesh.tets.size());
  const ElasticScale scale{.material = options.material, .opening = options.opening};
  const GroupSparseEnergy energy = elastic_energy(mesh, scale);
  ModeFinder finder(energy, matching_penalty(scale), options, options.count, context);
  FractureModes modes;
  modes.displacement.resize(3 * tets, options.count);
  modes.corner_displacement.resize(12 * tets, options.count);
  for (int m = 0; m < options.count; ++m) {
    context.progress.update("modes", static_cast<double>(m) / options.count);
    const Mode mode = finder.next();
    modes.corner_displacement.col(m) = mode.field;
    for (Eigen::Index t = 0; t < tets; ++t) {
      const Eigen::Map<const Eigen::Matrix<double, 3, 4>> corners(mode.field.data() + 12 * t);
      modes.displacement.col(m).segment<3>(3 * t) = corners.rowwise().mean();
    }
    add_facts(modes, mode);
    add_pieces(modes, joined_below(mesh, options.jump_threshold, [&](const auto& face) {
                 return elastic_jump(mesh, face, mode.field);
               }));
  }
  return modes;
}

}  // namespace

std::vector<std::int32_t> pieces_of(const TetMesh& mesh, const VectorXd& displacement,
                                    int dimension, double threshold) {
  return joined_below(mesh, threshold, [&](const TetMesh::InteriorFace& face) {
    return (displacement.segment(dimension * face.tets[0], dimension) -
            displacement.segment(dimension * face.tets[1], dimension))
        .norm();
  });
}

FractureModes compute_modes(const TetMesh& mesh, const ModesOptions& options, Context& context) {
  check(mesh, options);
  return options.elastic ? elastic_modes(mesh, options, context)
                         : constant_modes(mesh, options, context);
}

}  // namespace fracbench::modes
