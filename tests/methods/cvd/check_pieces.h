#pragma once

#include <string>
#include <vector>

#include "core/breakable.h"
#include "core/triangle_mesh.h"

namespace fracbench::test {

/// Edges without exactly one opposite and vertices without exactly one fan.
std::size_t count_topology_errors(const TriangleMesh& mesh);

/// What must hold for the pieces of `body` whatever the method: closed, manifold, oriented,
/// positive volumes that add up; the body's surface kept bit for bit; interfaces the same on both
/// sides.
void expect_filled(const TriangleMesh& body, const std::vector<Piece>& pieces);

/// The same, and no face crosses another, of the same or another piece; for pieces that meet by
/// threes, as Voronoi cells do, and do not break again.
void expect_partition(const TriangleMesh& body, const std::vector<Piece>& pieces);

/// Pairs of faces that cross in the complex of all pieces, in which neighbours share the faces
/// between them: 0 where each piece is free of self-intersections and all are disjoint.
std::size_t count_crossings(const std::vector<Piece>& pieces);

/// A digest of all that the pieces hold.
std::string digest(const std::vector<Piece>& pieces);

/// Volumes, smallest first.
std::vector<double> sorted_volumes(const std::vector<Piece>& pieces);

}  // namespace fracbench::test
