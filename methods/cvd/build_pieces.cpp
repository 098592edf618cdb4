#include <algorithm>

#include "core/parallel.h"
#include "methods/cvd/pieces.h"

namespace fracbench::cvd {

namespace {

// Gives the vertices that a piece uses their numbers in it, in the order of the complex.
void compact(const CellComplex& complex, TriangleMesh& mesh) {
  std::vector<std::int32_t> used;
  used.reserve(3 * mesh.faces.size());
  for (const Face& face : mesh.faces) used.insert(used.end(), face.begin(), face.end());
  std::ranges::sort(used);
  used.erase(std::ranges::unique(used).begin(), used.end());
  for (Face& face : mesh.faces) {
    for (std::int32_t& v : face) {
      v = static_cast<std::int32_t>(std::ranges::lower_bound(used, v) - used.begin());
    }
  }
  mesh.vertices.reserve(used.size());
  for (const std::int32_t v : used) mesh.vertices.push_back(complex.vertices[v]);
}

}  // namespace

std::vector<Piece> build_pieces(const CellComplex& complex, const CellParts& parts,
                                const std::vector<std::int32_t>& piece_of_part, int threads) {
  const std::int32_t count =
      piece_of_part.empty() ? 0 : *std::ranges::max_element(piece_of_part) + 1;
  std::vector<Piece> pieces(count);
  const auto add = [&](std::int32_t piece, const Face& corners, const PieceFace& face) {
    pieces[piece].mesh.faces.push_back(corners);
    pieces[piece].faces.push_back(face);
  };
  for (std::size_t t = 0; t < complex.surface.size(); ++t) {
    const SurfaceTriangle& triangle = complex.surface[t];
    add(piece_of_part[parts.of_surface[t]], triangle.corners, {triangle.parent_face, -1});
  }
  for (std::size_t t = 0; t < complex.cracks.size(); ++t) {
    const auto& [a, b, c] = complex.cracks[t].corners;
    const std::int32_t front = piece_of_part[parts.of_cracks[t][0]];
    const std::int32_t back = piece_of_part[parts.of_cracks[t][1]];
    if (front == back) continue;
    add(front, {a, b, c}, {-1, back});
    add(back, {a, c, b}, {-1, front});
  }
  parallel_for(pieces.size(), threads, [&](std::size_t p) { compact(complex, pieces[p].mesh); });
  return pieces;
}

}  // namespace fracbench::cvd
