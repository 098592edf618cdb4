#include "geometry/write_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/atomic_file.h"
#include "core/error.h"
#include "geometry/formats/writers.h"

namespace fracbench {

namespace {

using formats::Motion;
using formats::Part;

/// A sphere of rings of quadrilaterals with a triangle fan at each pole.
TriangleMesh sphere(double radius) {
  constexpr int rings = 16;
  constexpr int sectors = 32;
  TriangleMesh mesh;
  mesh.vertices.emplace_back(0, radius, 0);
  for (int r = 1; r < rings; ++r) {
    const double polar = std::numbers::pi * r / rings;
    for (int s = 0; s < sectors; ++s) {
      const double around = 2 * std::numbers::pi * s / sectors;
      mesh.vertices.emplace_back(radius * std::sin(polar) * std::sin(around),
                                 radius * std::cos(polar),
                                 radius * std::sin(polar) * std::cos(around));
    }
  }
  mesh.vertices.emplace_back(0, -radius, 0);
  const auto at = [](int ring, int sector) { return 1 + (ring - 1) * sectors + sector % sectors; };
  const int south = static_cast<int>(mesh.vertices.size()) - 1;
  for (int s = 0; s < sectors; ++s) {
    mesh.faces.push_back({0, at(1, s), at(1, s + 1)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.faces.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      mesh.faces.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
    mesh.faces.push_back({at(rings - 1, s), south, at(rings - 1, s + 1)});
  }
  return mesh;
}

const Track* find_track(const Trajectory& trajectory, Track::Kind kind, std::int32_t index) {
  const auto found = std::ranges::find_if(trajectory.tracks, [&](const Track& track) {
    return track.kind == kind && track.index == index && !track.poses.empty();
  });
  return found == trajectory.tracks.end() ? nullptr : &*found;
}

void append(Motion& motion, const Trajectory& trajectory, const Track& track, int until) {
  for (std::size_t k = 0; k < track.poses.size(); ++k) {
    const int frame = track.first_frame + static_cast<int>(k);
    if (frame >= until) return;
    motion.seconds.push_back(static_cast<float>(frame * trajectory.frame_seconds));
    motion.poses.push_back(track.poses[k]);
  }
}

Motion motion_of(const Trajectory& trajectory, const Track& track) {
  Motion motion;
  append(motion, trajectory, track, std::numeric_limits<int>::max());
  return motion;
}

Motion motion_of(const Trajectory& trajectory, const Fragment& fragment) {
  Motion motion;
  const Track* own = find_track(trajectory, Track::Kind::piece, fragment.piece);
  const int begin = own ? own->first_frame : std::numeric_limits<int>::max();
  if (const Track* parent = find_track(trajectory, Track::Kind::piece, fragment.parent)) {
    append(motion, trajectory, *parent, begin);
  }
  if (own) append(motion, trajectory, *own, std::numeric_limits<int>::max());
  return motion;
}

}  // namespace

void write_motion(const std::filesystem::path& file, const TriangleMesh& target,
                  const Fragments& fragments, const Trajectory& trajectory,
                  std::span<const double> ball_radii) {
  std::vector<Part> parts;
  std::vector<TriangleMesh> balls;
  balls.reserve(ball_radii.size());  // parts point into it
  if (const Track* track = find_track(trajectory, Track::Kind::target, 0)) {
    parts.push_back({.name = "target", .mesh = &target, .motion = motion_of(trajectory, *track)});
  }
  for (const Fragment& fragment : fragments) {
    std::vector<std::uint8_t> fracture;
    for (const FragmentFace& face : fragment.faces) fracture.push_back(face.is_fracture() ? 1 : 0);
    parts.push_back({.name = fmt::format("fragment {}", fragment.piece),
                     .mesh = &fragment.mesh,
                     .fracture = std::move(fracture),
                     .motion = motion_of(trajectory, fragment)});
  }
  for (std::size_t i = 0; i < ball_radii.size(); ++i) {
    const Track* track = find_track(trajectory, Track::Kind::ball, static_cast<std::int32_t>(i));
    if (!track) continue;
    balls.push_back(sphere(ball_radii[i]));
    parts.push_back({.name = fmt::format("ball {}", i),
                     .mesh = &balls.back(),
                     .motion = motion_of(trajectory, *track)});
  }
  write_file_atomically(file, formats::glb_bytes(parts));
}

}  // namespace fracbench
