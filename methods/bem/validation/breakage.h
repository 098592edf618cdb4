#pragma once

#include <span>
#include <vector>

#include "core/breakable.h"
#include "core/material.h"
#include "core/options.h"
#include "core/voxel_grid.h"
#include "methods/validation.h"

namespace fracbench::bem {

/// Glass, whose toughness binds: with the published material of the paper it never does.
inline constexpr Material kGlass{.young_modulus = 7e10,
                                 .poisson_ratio = 0.22,
                                 .density = 2500,
                                 .strength = 5e7,
                                 .toughness = 7.5e5};

/// The body that is broken: a box of longest side 1.9 without any symmetry between its axes.
TriangleMesh test_box();

/// Points of the box's surface, away from edges and spread over its sides, with the inward normal:
/// where it is hit.
struct Hit {
  Vec3 point;
  Vec3 direction;
};
std::vector<Hit> test_hits();

/// The impact of the standard ball (radius 0.4 m, density 8900 kg / m^3) at `speed`, m/s.
Impact ball_impact(const TriangleMesh& body, const Material& material, const Hit& hit,
                   double speed);

/// What a body breaks into under one impact with `options` over those of the coarse scale (400
/// triangles, voxel 0.04).
struct Breakage {
  TriangleMesh body = test_box();
  Material material = {};
  OptionMap options = {};
  std::uint64_t seed = 1;

  std::vector<Piece> pieces(const Hit& hit, double speed, Context& context) const;
};

/// Volumes over that of all, descending.
std::vector<double> relative_volumes(std::span<const Piece> pieces);

/// For each voxel of a grid over the test box's bounding cube: the index of the piece that holds
/// it, or -1. `turn` maps the grid's frame to that of the pieces.
std::vector<std::int32_t> piece_labels(std::span<const Piece> pieces, const Mat3& turn,
                                       int threads);

}  // namespace fracbench::bem
