#include <algorithm>

#include "methods/cvd/pieces.h"

namespace fracbench::cvd {

namespace {

// A face of a piece, with the cell whose triangle it is.
struct OwnedFace {
  Face corners;
  std::int32_t cell;
  std::int32_t piece;
  PieceFace tag;
};

// The vertices' numbers in the pieces. A vertex stands for one vertex in each piece around it; that
// piece may have come to it by several cells.
class PieceVertices {
 public:
  explicit PieceVertices(const CellComplex& complex)
      : complex_(complex), slots_(4 * complex.vertices.size(), -1) {}

  void use(const OwnedFace& face) {
    for (const std::int32_t v : face.corners) slots_[slot(v, face.cell)] = face.piece;
  }

  // Turns the piece in each slot into the vertex's number in that piece.
  void number(std::vector<Piece>& pieces) {
    for (std::size_t v = 0; v < complex_.vertices.size(); ++v) {
      std::array<std::int32_t, 4> piece;
      std::copy_n(slots_.begin() + 4 * v, 4, piece.begin());
      for (std::size_t s = 0; s < 4; ++s) {
        if (piece[s] < 0) continue;
        const std::size_t first = std::ranges::find(piece, piece[s]) - piece.begin();
        auto& vertices = pieces[piece[s]].mesh.vertices;
        if (first == s) vertices.push_back(complex_.vertices[v]);
        slots_[4 * v + s] = static_cast<std::int32_t>(vertices.size()) - 1;
      }
    }
  }

  Face numbers(const OwnedFace& face) const {
    const auto& [a, b, c] = face.corners;
    return {slots_[slot(a, face.cell)], slots_[slot(b, face.cell)], slots_[slot(c, face.cell)]};
  }

 private:
  std::size_t slot(std::int32_t vertex, std::int32_t cell) const {
    const auto& cells = complex_.cells_at[vertex];
    std::size_t s = 0;
    while (cells[s] != cell) ++s;
    return 4 * static_cast<std::size_t>(vertex) + s;
  }

  const CellComplex& complex_;
  std::vector<std::int32_t> slots_;
};

}  // namespace

std::vector<Piece> build_pieces(const CellComplex& complex, const CellParts& parts,
                                const std::vector<std::int32_t>& piece_of_part) {
  std::vector<OwnedFace> faces;
  faces.reserve(complex.surface.size() + 2 * complex.cracks.size());
  for (std::size_t t = 0; t < complex.surface.size(); ++t) {
    const auto& [corners, cell, parent] = complex.surface[t];
    faces.push_back({corners, cell, piece_of_part[parts.of_surface[t]], {parent, -1}});
  }
  for (std::size_t t = 0; t < complex.cracks.size(); ++t) {
    const auto& [corners, cells] = complex.cracks[t];
    const auto& [a, b, c] = corners;
    const std::int32_t front = piece_of_part[parts.of_cracks[t][0]];
    const std::int32_t back = piece_of_part[parts.of_cracks[t][1]];
    if (front == back) continue;
    faces.push_back({{a, b, c}, cells[0], front, {-1, back}});
    faces.push_back({{a, c, b}, cells[1], back, {-1, front}});
  }

  std::vector<std::size_t> sizes;
  PieceVertices vertices(complex);
  for (const OwnedFace& face : faces) {
    vertices.use(face);
    if (sizes.size() <= static_cast<std::size_t>(face.piece)) sizes.resize(face.piece + 1);
    ++sizes[face.piece];
  }
  std::vector<Piece> pieces(sizes.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    pieces[p].mesh.vertices.reserve(sizes[p] / 2 + 2);  // Euler's formula for a ball
    pieces[p].mesh.faces.reserve(sizes[p]);
    pieces[p].faces.reserve(sizes[p]);
  }
  vertices.number(pieces);
  for (const OwnedFace& face : faces) {
    pieces[face.piece].mesh.faces.push_back(vertices.numbers(face));
    pieces[face.piece].faces.push_back(face.tag);
  }
  return pieces;
}

}  // namespace fracbench::cvd
