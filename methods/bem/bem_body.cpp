#include "methods/bem/bem_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/error.h"
#include "geometry/measures.h"
#include "geometry/remesh.h"
#include "geometry/surface_distance.h"
#include "methods/bem/body_files.h"
#include "methods/bem/body_stress.h"
#include "methods/bem/contact_load.h"
#include "methods/bem/fast_model.h"
#include "methods/bem/full_model.h"
#include "methods/bem/load_balance.h"
#include "methods/bem/pictures.h"
#include "methods/bem/surface_stress.h"

namespace fracbench::bem {
namespace {

constexpr int kFewestElements = 200;
constexpr double kFarthestShare = 0.02;  // of the body's size: an impact farther off is refused

void check_impact(const Impact& impact, const TriangleMesh& body) {
  if (impact.impulses.empty()) throw InputError("bem: an impact without an impulse");
  if (!(impact.time_step > 0)) {
    throw InputError(
        fmt::format("bem: the impact's time step is {} s, must be above 0", impact.time_step));
  }
  const SurfaceDistance surface(body);
  const double size = bounding_box(body).longest_side();
  for (const Impulse& impulse : impact.impulses) {
    const Vec3& p = impulse.point;
    const double distance = p.allFinite() ? surface.nearest(p).distance : HUGE_VAL;
    if (distance <= kFarthestShare * size) continue;
    throw InputError(
        fmt::format("bem: the impact at ({:.6g}, {:.6g}, {:.6g}) is {:.4g} m off the surface; "
                    "allowed is {:.4g} m (2 % of the body's longest side)",
                    p.x(), p.y(), p.z(), distance, kFarthestShare * size));
  }
}

std::string_view name_of(PropagationEnd end) {
  switch (end) {
    case PropagationEnd::no_crack:
      return "the strength is nowhere exceeded";
    case PropagationEnd::time_over:
      return "the load ended while cracks advanced";
    case PropagationEnd::complete:
      return "every crack ended at the surface or at another crack";
    default:
      return "cracks were arrested";
  }
}

/// A line for the record; one that is there already is not repeated, since a scene may ask the same
/// piece at every touch.
void note_once(const Context& context, std::string line) {
  if (context.notes && std::ranges::find(*context.notes, line) != context.notes->end()) return;
  context.note(std::move(line));
}

/// Who breaks: the target, or which of the scene's pieces.
std::string name_in_notes(const Impact& impact) {
  return impact.fragment < 0 ? std::string("the target") : fmt::format("piece {}", impact.fragment);
}

void leave_notes(const Propagation& growth, const FragmentReport& fragments, std::size_t pieces,
                 const Impact& impact, const Context& context) {
  const PropagationReport& r = growth.report;
  note_once(context,
            fmt::format("bem, {}: {} cracks of {:.3g} m^2 in {} steps ({:.3g} s): {}; {} {}, {} "
                        "cracks separate nothing, {} chips joined to neighbours, {} starts failed",
                        name_in_notes(impact), growth.cracks.size(), r.area, r.steps, r.time,
                        name_of(r.end), pieces, pieces == 1 ? "piece, not separated" : "pieces",
                        fragments.cracks_within, fragments.merged_parts, r.failed_seeds));
  for (const std::string& failure : r.failures) {
    note_once(context, fmt::format("bem, {}: {}", name_in_notes(impact), failure));
  }
}

void leave_note(const FullModelReport& r, const Impact& impact, const Context& context) {
  note_once(context,
            fmt::format("bem, {}: {} solves with at most {} unknowns; {} of {} mouths at the "
                        "surface without a conforming mesh, {} solves repeated, {} components of "
                        "openings held",
                        name_in_notes(impact), r.solves, r.most_unknowns, r.overshooting,
                        r.cracks_at_surface, r.repeated, r.held));
}

/// For each label, the part of each crack's surface that runs inside it: the triangles that cut
/// links there and none between labels.
std::map<std::int32_t, std::vector<Crack>> cracks_within(const std::vector<Crack>& cracks,
                                                         const CutLinks& links,
                                                         const VoxelGrid<std::int32_t>& labels) {
  std::set<std::int32_t> partial;
  links.for_each_cut([&](std::int32_t a, std::int32_t b, std::int32_t crack) {
    if (labels.values[a] == labels.values[b]) partial.insert(crack);
  });
  std::map<std::int32_t, std::vector<Crack>> result;
  for (const std::int32_t c : partial) {
    const Crack& crack = cracks[c];
    std::map<std::int32_t, std::vector<Face>> faces;
    for (std::size_t f = 0; f < crack.surface.faces.size(); ++f) {
      const auto pairs = links.crossed_by(
          {crack.surface.corner(f, 0), crack.surface.corner(f, 1), crack.surface.corner(f, 2)});
      if (pairs.empty()) continue;
      const std::int32_t label = labels.values[pairs.front()[0]];
      const bool within = std::all_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
        return labels.values[pair[0]] == label && labels.values[pair[1]] == label;
      });
      if (within) faces[label].push_back(crack.surface.faces[f]);
    }
    for (auto& [label, part] : faces) {
      result[label].push_back(crack);
      result[label].back().surface.faces = std::move(part);
    }
  }
  return result;
}

}  // namespace

int element_count(const BodyState& state) {
  const int all = state.settings.triangles;
  if (!state.is_piece) return all;
  const double share = area(state.body.mesh) / state.target_area;
  return std::clamp(static_cast<int>(std::lround(share * all)), std::min(kFewestElements, all),
                    all);
}

BemBody::BemBody(BodyState state) : state_(std::move(state)), elements_(state_.elements) {}

BemBody::~BemBody() = default;

void BemBody::prepare(Context& context) const { ready(context); }

const BemBody::Ready& BemBody::ready(Context& context) const {
  const std::scoped_lock lock(mutex_);
  if (ready_) return *ready_;
  if (!refusal_.empty()) throw InputError(refusal_);
  try {
    if (!elements_) {
      const auto stage = context.timer.stage("remesh");
      elements_ = remesh(state_.body.mesh, state_.body.name,
                         {.triangles = element_count(state_),
                          .allow_isosurface = state_.is_piece,
                          .quick = state_.is_piece,
                          .threads = context.threads,
                          .stop = context.stop})
                      .mesh;
    }
    context.stop_if_asked();
    auto links = [&] {
      const auto stage = context.timer.stage("grid");
      return CutLinks(state_.body.mesh, state_.settings.voxel, context.threads);
    }();
    context.stop_if_asked();
    const ElasticCost cost = predict_cost(elements_->faces.size());
    context.progress.update(
        fmt::format("boundary elements: {} triangles, about {:.2g} s and {:.3g} MB",
                    elements_->faces.size(), cost.seconds(context.threads),
                    static_cast<double>(cost.bytes) / 1e6),
        0);
    ready_ = std::make_unique<const Ready>(
        Ready{ElasticBody(*elements_, state_.body.material, context), std::move(links)});
  } catch (const InputError& error) {
    refusal_ = error.what();
    throw;
  } catch (const MethodFailure& error) {
    if (!state_.is_piece) throw;
    refusal_ = error.what();
    throw InputError(refusal_);
  }
  return *ready_;
}

std::vector<Piece> BemBody::whole() const {
  const TriangleMesh& mesh = state_.body.mesh;
  Piece piece{.mesh = mesh, .faces = std::vector<PieceFace>(mesh.faces.size()), .next = nullptr};
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    piece.faces[f].parent_face = static_cast<std::int32_t>(f);
  }
  return {std::move(piece)};
}

std::vector<Piece> BemBody::fracture(const Impact& impact, Context& context) const {
  const Material& material = state_.body.material;
  check_impact(impact, state_.body.mesh);
  const Ready* body = nullptr;
  try {
    body = &ready(context);
  } catch (const InputError& error) {
    if (!state_.is_piece) throw;
    // A piece is what an earlier break made it: that it cannot be handled is no mistake of the
    // user.
    note_once(context,
              fmt::format("bem, {}: stays whole: {}", name_in_notes(impact), error.what()));
    return whole();
  }
  const BoundaryElements& elements = body->elastic.elements();

  double duration = 0;
  BalancedLoad load;
  {
    const auto stage = context.timer.stage("load");
    const std::vector<ContactPatch> patches = contact_patches(elements, material, impact);
    duration = std::min(impact.time_step, load_duration(patches));
    load = balance_load(elements, contact_tractions(elements, patches), material,
                        state_.settings.balance);
  }
  const auto stress = [&] {
    const auto stage = context.timer.stage("solve");
    return std::make_shared<const BodyStress>(body->elastic, load, context);
  }();
  context.stop_if_asked();

  const std::uint64_t seed =
      state_.is_piece ? state_.strength_seed : context.random.fork("strength").seed();
  StrengthOptions strength = state_.settings.strength;
  strength.mean = material.strength;
  strength.seed = seed;

  FractureModel model;
  std::optional<FullModel> full;
  if (state_.settings.mode == Mode::full) {
    full.emplace(*elements_, stress_field(stress, context.threads), stress->on_surface(), material,
                 context);
    model.surface_stress = [&](std::span<const CrackSheet> cracks) {
      const auto stage = context.timer.stage("full solve");
      return full->surface_stress(cracks);
    };
    model.stress_intensity = [&](std::span<const CrackSheet> cracks) {
      const auto stage = context.timer.stage("full solve");
      return full->stress_intensity(cracks);
    };
    model.stress_changes = true;
  } else {
    model.surface_stress = [&](std::span<const CrackSheet>) {
      const auto stage = context.timer.stage("initiation");
      return surface_stress(*elements_, stress->on_surface());
    };
    model.stress_intensity =
        [&, fast = fast_model(stress_field(stress, context.threads),
                              state_.settings.calibrated
                                  ? FastFactors::calibrated(material.poisson_ratio)
                                  : FastFactors::authors(),
                              material.compressive_factor)](std::span<const CrackSheet> cracks) {
          const auto stage = context.timer.stage("stress");
          return fast(cracks);
        };
  }

  CutLinks links = body->links;
  const Propagation growth = [&] {
    const auto stage = context.timer.stage("propagation");
    return propagate(state_.cracks, links, StrengthField(strength), model,
                     {.material = material,
                      .max_cracks = state_.settings.max_cracks,
                      .mesh_size = state_.settings.crack_mesh,
                      .duration = duration,
                      .parity = state_.settings.parity},
                     context);
  }();
  context.stop_if_asked();

  CrackFragments fragments;
  {
    const auto stage = context.timer.stage("partition");
    const double share = volume(state_.body.mesh) / state_.target_volume;
    fragments = crack_fragments(state_.body.mesh, links,
                                {.smallest = state_.settings.smallest_fragment,
                                 .smallest_voxels = state_.settings.smallest_voxels,
                                 .parity = state_.settings.parity,
                                 .hull_share = state_.settings.hull_volume / share},
                                context);
    if (fragments.pieces.size() > 1) give_next(fragments, growth, links, seed);
  }
  // Pieces are asked at every touch; what did not break them is not worth a line each.
  if (!state_.is_piece || fragments.pieces.size() > 1) {
    leave_notes(growth, fragments.report, fragments.pieces.size(), impact, context);
    if (full) leave_note(full->report(), impact, context);
  }
  if (!context.pictures.empty()) {
    const auto stage = context.timer.stage("pictures");
    write_pictures(context.pictures, impact.fragment,
                   {.elements = *elements_,
                    .stress = *stress,
                    .tractions = load.tractions,
                    .cracks = growth.cracks,
                    .stress_intensity = model.stress_intensity,
                    .labels = fragments.labels});
  }
  return std::move(fragments.pieces);
}

void BemBody::give_next(CrackFragments& fragments, const Propagation& growth, const CutLinks& links,
                        std::uint64_t strength_seed) const {
  const double smallest = state_.settings.refracture_volume * state_.target_volume;
  std::vector<std::size_t> large;
  for (std::size_t p = 0; p < fragments.pieces.size(); ++p) {
    if (volume(fragments.pieces[p].mesh) > smallest) large.push_back(p);
  }
  if (large.empty() || state_.settings.refracture_volume >= 1) return;
  const auto within = cracks_within(growth.cracks, links, fragments.labels);
  for (const std::size_t p : large) {
    Piece& piece = fragments.pieces[p];
    BodyState next{
        .settings = state_.settings,
        .body = {.name = state_.body.name, .mesh = piece.mesh, .material = state_.body.material},
        .target_volume = state_.target_volume,
        .target_area = state_.target_area,
        .is_piece = true,
        .strength_seed = strength_seed};
    if (const auto at = within.find(fragments.label_of[p]); at != within.end()) {
      next.cracks = at->second;
    }
    piece.next = std::make_shared<BemBody>(std::move(next));
  }
}

void BemBody::save(const std::filesystem::path& folder) const {
  const std::scoped_lock lock(mutex_);
  BodyState state = state_;
  state.elements = elements_;
  write_body(folder, state);
}

}  // namespace fracbench::bem
