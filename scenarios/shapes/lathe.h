#pragma once

#include <array>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench {

/// A point of a profile: distance from the z axis, and height.
using ProfilePoint = Eigen::Vector2d;

/// One smooth piece of a profile, a cubic Bezier curve.
using ProfilePiece = std::array<ProfilePoint, 4>;

ProfilePiece line_piece(const ProfilePoint& from, const ProfilePoint& to);
/// From `from` to `to`, leaving along `leave` and arriving along `arrive` (scaled control arms).
ProfilePiece curve_piece(const ProfilePoint& from, const ProfilePoint& leave,
                         const ProfilePoint& arrive, const ProfilePoint& to);

/// The outline of half a cross-section, the solid on its left: starts and ends on the axis, and
/// touches it nowhere else.
using Profile = std::vector<ProfilePiece>;

/// Points along the profile, about `spacing` apart by arc length, ends of pieces included.
std::vector<ProfilePoint> sample(const ProfilePiece& piece, double spacing);

/// A mesh that is put together ring by ring around the z axis.
class RingMesh {
 public:
  struct Ring {
    std::int32_t first = 0;    ///< vertex; the others follow counter-clockwise seen from +z
    std::int32_t count = 0;    ///< 1: a point of the axis
    bool half_turned = false;  ///< by half a segment
  };

  Ring add_ring(const ProfilePoint& at, std::int32_t count, bool half_turned);
  /// The band between two rings, of any counts, the second after the first along the profile.
  void add_band(const Ring& from, const Ring& to);

  TriangleMesh mesh;
};

/// Segments that keep the triangles of a ring of this radius about equilateral: multiples of 6, not
/// below `least`; 1 on the axis.
std::int32_t ring_segments(double radius, double spacing, std::int32_t least);

/// The solid of revolution of a profile, in triangles of about `spacing`. Rings off the axis have
/// segments as their radius asks for, and on the steep parts not below `least_segments`, so that
/// two close walls do not cut through each other's chords.
TriangleMesh lathe(const Profile& profile, double spacing, std::int32_t least_segments);

}  // namespace fracbench
