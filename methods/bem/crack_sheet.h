#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench::bem {

/// What a vertex on the boundary of a crack does.
enum class FrontState : std::uint8_t {
  advancing,   ///< part of the front: the opening is zero there
  at_surface,  ///< reached the body's surface, the crack's mouth: the opening is free there
  at_crack     ///< ran into another crack: the opening is 0 there
};

/// A crack as the boundary elements see it: one sheet of coarse triangles, both faces of the crack
/// in one. The opening (displacement of the upper side minus that of the lower) lives on its
/// vertices. The triangles' normals point from the lower side to the upper one.
struct CrackSheet {
  TriangleMesh mesh;
  /// The boundary vertices in order, the sheet to the left of the way when seen from the upper
  /// side. A sheet has one boundary loop.
  std::vector<std::int32_t> boundary;
  std::vector<FrontState> states;  ///< parallel to boundary
};

/// Directions at a vertex of the boundary, an orthonormal frame.
struct FrontFrame {
  Vec3 forward;  ///< in the sheet's plane, away from the crack
  Vec3 normal;   ///< of the sheet, towards the upper side
  Vec3 tangent;  ///< along the front: forward x normal
};

/// Stress intensity factors at a vertex of the front, Pa sqrt(m). Mode I is negative where the
/// faces are pressed together.
struct StressIntensity {
  double mode_1 = 0;
  double mode_2 = 0;  ///< sliding along `forward`
  double mode_3 = 0;  ///< sliding along `tangent`
};

/// Stress intensities at every boundary vertex of every crack (those that do not advance: 0).
using StressIntensityModel =
    std::function<std::vector<std::vector<StressIntensity>>(std::span<const CrackSheet> cracks)>;

}  // namespace fracbench::bem
