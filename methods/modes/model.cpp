#include "methods/modes/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"

namespace fracbench::modes {
namespace {

// How far off the surface an impulse may be, as a share of the body's longest side.
constexpr double kFarthestShare = 0.02;

}  // namespace

Model::Model(const Target& target, ModelData data, const Strength& strength)
    : body_(target.mesh),
      material_(target.material),
      surface_(target.mesh),
      data_(std::move(data)),
      strength_(strength),
      faces_(data_.cut) {}

ModesBody::ModesBody(std::shared_ptr<const Model> model)
    : model_(std::move(model)), pieces_(model_->data().cut.cells.size()) {
  std::iota(pieces_.begin(), pieces_.end(), 0);
}

ModesBody::ModesBody(std::shared_ptr<const Model> model, std::vector<std::int32_t> pieces,
                     const BoundingBox& box)
    : model_(std::move(model)), pieces_(std::move(pieces)), whole_(false), box_(box) {}

void ModesBody::check(const Impact& impact) const {
  const double size = model_->data().projection.frame.size;
  for (const Impulse& impulse : impact.impulses) {
    const Vec3& p = impulse.point;
    if (!p.allFinite() || !impulse.direction.allFinite() || !std::isfinite(impulse.magnitude)) {
      throw InputError("modes: an impulse's point, direction or magnitude is not a finite number");
    }
    // A fragment's surface is not searched; its box tells gross mistakes.
    const double distance = whole_ ? model_->surface().nearest(p).distance
                                   : (p.cwiseMax(box_.low).cwiseMin(box_.high) - p).norm();
    if (distance > kFarthestShare * size) {
      throw InputError(fmt::format(
          "modes: the impulse at {:.6g},{:.6g},{:.6g} is {:.4g} m off the body's surface, allowed "
          "is {:.4g} m (2 % of its longest side); give a point on the surface",
          p.x(), p.y(), p.z(), distance, kFarthestShare * size));
    }
  }
}

std::vector<std::int32_t> ModesBody::groups_after(const Impact& impact) const {
  const ModelData& data = model_->data();
  std::vector<std::int32_t> together(pieces_.size(), 0);
  double total = 0;
  for (const Impulse& impulse : impact.impulses) total += impulse.magnitude;
  if (!(total > 0)) return together;
  const Eigen::MatrixX3d velocities =
      piece_velocities(data.projection, pieces_, impact.impulses, model_->material().density);
  const Strength& strength = model_->strength();
  double threshold = strength.raw_threshold;
  if (!strength.raw) {
    if (impact.overload < 1) return together;
    // Where the body answers less than elsewhere, it must still break when the break test says so.
    const double jump = parting_jump(data.projection, pieces_, velocities) / total;
    threshold = total / impact.overload * std::min(data.typical_jump, jump);
  }
  return held_together(data.projection, pieces_, velocities, threshold);
}

std::vector<Piece> ModesBody::pieces_of(const std::vector<std::int32_t>& group, int threads) const {
  std::vector<Piece> result = make_pieces(model_->fragments(), pieces_, group, whole_, threads);
  std::vector<std::vector<std::int32_t>> members(result.size());
  for (std::size_t n = 0; n < group.size(); ++n) members[group[n]].push_back(pieces_[n]);
  for (std::size_t g = 0; g < result.size(); ++g) {
    if (members[g].size() < 2) continue;
    result[g].next =
        std::make_shared<ModesBody>(model_, std::move(members[g]), bounding_box(result[g].mesh));
  }
  return result;
}

std::vector<Piece> ModesBody::fracture(const Impact& impact, Context& context) const {
  std::vector<std::int32_t> group;
  {
    const auto stage = context.timer.stage("impact_projection");
    check(impact);
    group = groups_after(impact);
  }
  context.stop_if_asked();
  const auto stage = context.timer.stage("fragments");
  const bool breaks = std::ranges::any_of(group, [](std::int32_t g) { return g > 0; });
  if (breaks || !whole_) return pieces_of(group, context.threads);
  Piece piece;
  piece.mesh = model_->body();
  for (std::size_t f = 0; f < piece.mesh.faces.size(); ++f) {
    piece.faces.push_back({static_cast<std::int32_t>(f), -1});
  }
  if (pieces_.size() > 1) piece.next = std::make_shared<ModesBody>(model_);
  std::vector<Piece> pieces;
  pieces.push_back(std::move(piece));
  return pieces;
}

void ModesBody::save(const std::filesystem::path& folder) const {
  if (!whole_) {
    throw InputError("modes: only a whole body can be saved, this is a fragment of one");
  }
  save_model(folder, *model_);
}

}  // namespace fracbench::modes
