#include "scenarios/shapes/lathe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fracbench {
namespace {

ProfilePoint at(const ProfilePiece& piece, double t) {
  const double s = 1 - t;
  return s * s * s * piece[0] + 3 * s * s * t * piece[1] + 3 * s * t * t * piece[2] +
         t * t * t * piece[3];
}

}  // namespace

ProfilePiece line_piece(const ProfilePoint& from, const ProfilePoint& to) {
  return {from, (2 * from + to) / 3, (from + 2 * to) / 3, to};
}

ProfilePiece curve_piece(const ProfilePoint& from, const ProfilePoint& leave,
                         const ProfilePoint& arrive, const ProfilePoint& to) {
  return {from, from + leave, to - arrive, to};
}

std::vector<ProfilePoint> sample(const ProfilePiece& piece, double spacing) {
  constexpr int fine = 200;
  std::array<double, fine + 1> length{};
  for (int i = 1; i <= fine; ++i) {
    length[i] =
        length[i - 1] + (at(piece, double(i) / fine) - at(piece, double(i - 1) / fine)).norm();
  }
  const int steps = std::max(1, static_cast<int>(std::lround(length[fine] / spacing)));
  std::vector<ProfilePoint> points{piece[0]};
  int i = 0;
  for (int k = 1; k < steps; ++k) {
    const double target = length[fine] * k / steps;
    while (length[i + 1] < target) ++i;
    const double part = (target - length[i]) / (length[i + 1] - length[i]);
    points.push_back(at(piece, (i + part) / fine));
  }
  points.push_back(piece[3]);
  return points;
}

RingMesh::Ring RingMesh::add_ring(const ProfilePoint& at, std::int32_t count, bool half_turned) {
  const Ring ring{static_cast<std::int32_t>(mesh.vertices.size()), count, half_turned};
  if (count == 1) {
    mesh.vertices.emplace_back(0, 0, at.y());
    return ring;
  }
  for (std::int32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + (half_turned ? 0.5 : 0.0)) / count;
    mesh.vertices.emplace_back(at.x() * std::cos(angle), at.x() * std::sin(angle), at.y());
  }
  return ring;
}

void RingMesh::add_band(const Ring& from, const Ring& to) {
  // Goes around both rings at once. The next triangle takes its new vertex from the ring whose next
  // segment has the smaller middle angle, which makes the shorter diagonal. Angles are compared as
  // whole numbers: 4 (i + 1/2 + 1/2 half_turned) / count, both sides times both counts.
  const auto middle = [](const Ring& ring, std::int64_t i) {
    return 2 * i + 1 + (ring.half_turned ? 1 : 0);
  };
  const std::int64_t from_steps = from.count > 1 ? from.count : 0;
  const std::int64_t to_steps = to.count > 1 ? to.count : 0;
  const auto id = [](const Ring& ring, std::int64_t i) {
    return ring.first + static_cast<std::int32_t>(i % ring.count);
  };
  for (std::int64_t i = 0, j = 0; i < from_steps || j < to_steps;) {
    const bool advance_from = j == to_steps || (i < from_steps && middle(from, i) * to_steps <=
                                                                      middle(to, j) * from_steps);
    if (advance_from) {
      mesh.faces.push_back({id(from, i), id(from, i + 1), id(to, j)});
      ++i;
    } else {
      mesh.faces.push_back({id(from, i), id(to, j + 1), id(to, j)});
      ++j;
    }
  }
}

std::int32_t ring_segments(double radius, double spacing, std::int32_t least) {
  const double sixths = 2 * std::numbers::pi * radius / (6 * spacing);
  return std::max(least, 6 * std::max(1, static_cast<std::int32_t>(std::lround(sixths))));
}

TriangleMesh lathe(const Profile& profile, double spacing, std::int32_t least_segments) {
  std::vector<ProfilePoint> points{profile.front()[0]};
  std::vector<bool> steep{false};
  for (const ProfilePiece& piece : profile) {
    const std::vector<ProfilePoint> samples = sample(piece, spacing);
    const ProfilePoint along = piece[3] - piece[0];
    const bool is_steep = std::abs(along.y()) > 0.1 * std::abs(along.x());
    steep.back() = steep.back() || is_steep;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      points.push_back(samples[i]);
      steep.push_back(is_steep);
    }
  }
  RingMesh rings;
  RingMesh::Ring last;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool on_axis = i == 0 || i + 1 == points.size();
    const std::int32_t count =
        on_axis ? 1 : ring_segments(points[i].x(), spacing, steep[i] ? least_segments : 6);
    const RingMesh::Ring ring = rings.add_ring(points[i], count, i % 2 == 1);
    if (i > 0) rings.add_band(last, ring);
    last = ring;
  }
  return std::move(rings.mesh);
}

}  // namespace fracbench
