#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/breakable.h"
#include "core/fragments.h"
#include "scenarios/rigid/mass_frame.h"
#include "scenarios/scene.h"

namespace fracbench {

/// Motion of a piece at the instant at which its parent breaks: the parent's own motion, as seen at
/// the piece's centre of mass.
BodyState piece_state(const BodyState& parent, const MassFrame& parent_frame,
                      const MassFrame& piece_frame);

/// What the replacement of `parent` by pieces in the states of piece_state() kept. The scales are
/// p = m (|v| + |w| r) and L = p r with r the body's radius of gyration.
Replacement measure_replacement(double time, const BodyState& parent, const MassFrame& parent_frame,
                                std::span<const MassFrame> pieces);

/// Where the faces of the pieces come from in terms of the scene's target, given where those of the
/// broken body do. Each crack between two pieces gets a number of its own from `next_interface` on,
/// which is moved on. Throws MethodFailure where tags and faces do not match.
std::vector<std::vector<FragmentFace>> compose_faces(std::span<const FragmentFace> body_faces,
                                                     std::span<const Piece> pieces,
                                                     std::int32_t& next_interface);

}  // namespace fracbench
