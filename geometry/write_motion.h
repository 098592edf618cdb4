#pragma once

#include <filesystem>
#include <span>

#include "core/fragments.h"
#include "core/trajectory.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// Writes a scene as an animated glTF 2.0 file (.glb): the target until it breaks, its fragments
/// from then on, and the balls, each a node that moves along its track, in the world's frame. A
/// fragment follows the piece that it broke from until it has a track of its own; what is not there
/// yet, or no longer, has the scale 0. Balls are spheres of the given radii, m, by their index.
/// Throws InputError where the file cannot be written.
void write_motion(const std::filesystem::path& file, const TriangleMesh& target,
                  const Fragments& fragments, const Trajectory& trajectory,
                  std::span<const double> ball_radii);

}  // namespace fracbench
