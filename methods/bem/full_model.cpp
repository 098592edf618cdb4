#include "methods/bem/full_model.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "methods/bem/refit_sheet.h"
#include "methods/bem/stress_intensity.h"
#include "methods/bem/surface_stress.h"

namespace fracbench::bem {
namespace {

bool same(const CrackSheet& a, const CrackSheet& b) {
  return a.states == b.states && a.boundary == b.boundary && a.mesh.faces == b.mesh.faces &&
         a.mesh.vertices == b.mesh.vertices;
}

/// The surface as it is, all sheets overshooting it.
ConformedCracks unconformed(const TriangleMesh& body, std::span<const CrackSheet> cracks) {
  ConformedCracks result;
  result.body.surface = body;
  result.body.sheets.assign(cracks.begin(), cracks.end());
  result.source_face.resize(body.faces.size());
  std::iota(result.source_face.begin(), result.source_face.end(), 0);
  for (const CrackSheet& crack : cracks) {
    auto& source = result.source_boundary.emplace_back(crack.boundary.size());
    std::iota(source.begin(), source.end(), 0);
    if (!mouth_runs(crack).empty()) ++result.body.overshooting;
  }
  return result;
}

}  // namespace

FullModel::FullModel(TriangleMesh body, StressField stress, std::vector<Mat3> on_surface,
                     const Material& material, Context& context)
    : body_(std::move(body)),
      on_surface_(std::move(on_surface)),
      material_(material),
      context_(&context),
      system_(material, std::move(stress)) {
  if (on_surface_.size() != body_.faces.size()) {
    throw InputError("stress on " + std::to_string(on_surface_.size()) +
                     " triangles for a body of " + std::to_string(body_.faces.size()) +
                     ": give it for each");
  }
}

FullModel::State FullModel::solve_conformed(std::span<const CrackSheet> cracks, bool conform) {
  State state{.cracks = {cracks.begin(), cracks.end()},
              .conformed = conform ? conform_cracks(body_, cracks) : unconformed(body_, cracks),
              .solution = {}};
  state.solution = system_.solve(state.conformed.body, *context_);
  return state;
}

const FullModel::State& FullModel::solve(std::span<const CrackSheet> cracks) {
  if (last_ && std::ranges::equal(last_->cracks, cracks, same)) return *last_;
  const auto stage = context_->timer.stage("cracks");
  context_->stop_if_asked();
  last_.reset();
  std::string reason;
  try {
    last_ = solve_conformed(cracks, true);
  } catch (const MethodFailure& failure) {
    reason = failure.what();
  } catch (const InputError& error) {  // a sheet or carved triangle without area
    reason = error.what();
  }
  if (!last_) {
    ++report_.repeated;
    report_.repeated_for = reason;
    try {
      last_ = solve_conformed(cracks, false);
    } catch (const InputError& error) {
      throw MethodFailure(std::string("a crack's mesh broke down: ") + error.what() +
                          "; before: " + reason);
    }
  }
  ++report_.solves;
  report_.held += last_->solution.held;
  report_.overshooting += last_->conformed.body.overshooting;
  for (const CrackSheet& crack : cracks) {
    if (!mouth_runs(crack).empty()) ++report_.cracks_at_surface;
  }
  report_.most_unknowns = std::max(report_.most_unknowns, system_.unknowns());
  return *last_;
}

std::vector<std::vector<StressIntensity>> FullModel::stress_intensity(
    std::span<const CrackSheet> cracks) {
  const State& state = solve(cracks);
  std::vector<std::vector<StressIntensity>> result;
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    auto& intensities = result.emplace_back(cracks[c].boundary.size());
    const std::vector<StressIntensity> found = stress_intensity_from_opening(
        state.conformed.body.sheets[c], state.solution.openings[c], material_);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::int32_t source = state.conformed.source_boundary[c][i];
      if (source >= 0) intensities[source] = found[i];
    }
  }
  return result;
}

SurfaceStress FullModel::surface_stress(std::span<const CrackSheet> cracks) {
  // Without cracks there is nothing to solve.
  if (cracks.empty()) return bem::surface_stress(body_, on_surface_);
  const State& state = solve(cracks);
  const TriangleMesh& surface = state.conformed.body.surface;
  Eigen::VectorXd displacements(3 * surface.vertices.size());
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    displacements.segment<3>(static_cast<Eigen::Index>(3 * v)) = state.solution.displacements[v];
  }
  const auto count = static_cast<Eigen::Index>(surface.faces.size());
  std::vector<Mat3> stress = bem::surface_stress(make_boundary_elements(surface), displacements,
                                                 Eigen::Matrix3Xd::Zero(3, count), material_);
  for (std::size_t t = 0; t < stress.size(); ++t) {
    stress[t] += on_surface_[state.conformed.source_face[t]];
  }
  return bem::surface_stress(surface, std::move(stress));
}

}  // namespace fracbench::bem
