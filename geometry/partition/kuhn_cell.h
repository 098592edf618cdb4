#pragma once

#include <array>
#include <cstdint>
#include <vector>

// The combinatorics of a grid cell and of its Kuhn subdivision into six tetrahedra. Corners of a
// cell, and steps from a sample to another one, are numbers from 0 to 7: bit 0 is a step along x,
// bit 1 along y, bit 2 along z. The tetrahedra are the chains 0 < a < a|b < 7 of corners, so that
// neighbouring cells agree on the diagonals of their common face.
namespace fracbench::partition {

/// One of the tetrahedra around an edge of the subdivision.
struct RingStep {
  std::uint8_t cell = 0;         ///< the cell's lowest sample is the edge's start minus this step
  std::uint8_t tetrahedron = 0;  ///< 0 to 5
  /// The triangle between this tetrahedron and the next one: its lowest sample relative to the
  /// edge's start (0 or -1 per axis: minus this step), and its kind, 0 to 11.
  std::uint8_t triangle_base = 0;
  std::uint8_t triangle_kind = 0;
};

struct KuhnTables {
  /// Per direction 1 to 7 of an edge: the tetrahedra around it, counter-clockwise seen from its
  /// end.
  std::array<std::vector<RingStep>, 8> ring;
  /// Per kind of triangle: its two steps from the lowest sample.
  std::array<std::array<std::uint8_t, 2>, 12> triangle_steps;
  /// Corners of the tetrahedra.
  std::array<std::array<std::uint8_t, 4>, 6> tetrahedron;
  /// Whether a set of corners (bit mask) can be separated from the others by one disc that crosses
  /// every side of the cell at most once: both are connected along edges, and no side has them on
  /// its two diagonals.
  std::array<bool, 256> simple;
};

const KuhnTables& kuhn_tables();

}  // namespace fracbench::partition
