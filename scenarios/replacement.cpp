#include "scenarios/replacement.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "core/error.h"

namespace fracbench {

namespace {

double kinetic_energy(const BodyState& state, const MassFrame& frame) {
  return (frame.mass * state.velocity.squaredNorm() +
          state.angular_velocity.dot(frame.world_inertia(state.pose) * state.angular_velocity)) /
         2;
}

/// About `origin`, in world axes.
Vec3 angular_momentum(const BodyState& state, const MassFrame& frame, const Vec3& origin) {
  return frame.world_inertia(state.pose) * state.angular_velocity +
         frame.mass * (state.pose.to_world(frame.center) - origin).cross(state.velocity);
}

double relative(double value, double scale) { return scale > 0 ? value / scale : value; }

}  // namespace

BodyState piece_state(const BodyState& parent, const MassFrame& parent_frame,
                      const MassFrame& piece_frame) {
  BodyState state = parent;
  state.velocity = velocity_at(parent, parent_frame, parent.pose.to_world(piece_frame.center));
  return state;
}

Replacement measure_replacement(double time, const BodyState& parent, const MassFrame& parent_frame,
                                std::span<const MassFrame> pieces) {
  const Vec3 origin = parent.pose.to_world(parent_frame.center);
  Vec3 momentum = -parent_frame.mass * parent.velocity;
  Vec3 turning = -angular_momentum(parent, parent_frame, origin);
  double energy = 0;
  for (const MassFrame& frame : pieces) {
    const BodyState state = piece_state(parent, parent_frame, frame);
    momentum += frame.mass * state.velocity;
    turning += angular_momentum(state, frame, origin);
    energy += kinetic_energy(state, frame);
  }
  const double gyration = std::sqrt(parent_frame.inertia.sum() / (2 * parent_frame.mass));
  const double scale =
      parent_frame.mass * (parent.velocity.norm() + parent.angular_velocity.norm() * gyration);
  const double energy_before = kinetic_energy(parent, parent_frame);
  return {.time = time,
          .momentum_error = relative(momentum.norm(), scale),
          .angular_momentum_error = relative(turning.norm(), scale * gyration),
          .energy_ratio = energy_before > 0 ? energy / energy_before : 1};
}

std::vector<std::vector<FragmentFace>> compose_faces(std::span<const FragmentFace> body_faces,
                                                     std::span<const Piece> pieces,
                                                     std::int32_t& next_interface) {
  const auto piece_count = static_cast<std::int32_t>(pieces.size());
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> interfaces;
  std::vector<std::vector<FragmentFace>> composed(pieces.size());
  for (std::int32_t p = 0; p < piece_count; ++p) {
    const Piece& piece = pieces[p];
    if (piece.faces.size() != piece.mesh.faces.size()) {
      throw MethodFailure(fmt::format("piece {} has {} faces but {} face tags", p,
                                      piece.mesh.faces.size(), piece.faces.size()));
    }
    for (const PieceFace& face : piece.faces) {
      FragmentFace tag;
      if (!face.is_fracture()) {
        if (face.parent_face >= static_cast<std::int32_t>(body_faces.size())) {
          throw MethodFailure(fmt::format("piece {} names face {} of a body that has {} faces", p,
                                          face.parent_face, body_faces.size()));
        }
        tag = body_faces[face.parent_face];
      } else if (face.neighbour >= piece_count || face.neighbour == p) {
        throw MethodFailure(fmt::format("piece {} names neighbour {}, there are {} pieces", p,
                                        face.neighbour, piece_count));
      } else if (face.neighbour >= 0) {
        const auto [found, is_new] =
            interfaces.try_emplace(std::minmax(p, face.neighbour), next_interface);
        if (is_new) ++next_interface;
        tag.interface = found->second;
      }
      composed[p].push_back(tag);
    }
  }
  return composed;
}

}  // namespace fracbench
