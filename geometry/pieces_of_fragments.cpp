#include "geometry/pieces_of_fragments.h"

#include <algorithm>
#include <map>

namespace fracbench {

std::vector<Piece> pieces_of_fragments(const Fragments& fragments) {
  std::map<std::int32_t, std::vector<std::int32_t>> owners;  // of each crack
  for (std::size_t n = 0; n < fragments.size(); ++n) {
    for (const FragmentFace& face : fragments[n].faces) {
      if (!face.is_fracture() || face.interface < 0) continue;
      std::vector<std::int32_t>& list = owners[face.interface];
      const auto piece = static_cast<std::int32_t>(n);
      if (std::ranges::find(list, piece) == list.end()) list.push_back(piece);
    }
  }
  std::vector<Piece> pieces;
  for (std::size_t n = 0; n < fragments.size(); ++n) {
    Piece piece{.mesh = fragments[n].mesh, .faces = {}, .next = nullptr};
    for (const FragmentFace& face : fragments[n].faces) {
      PieceFace tag{.parent_face = face.original_face, .neighbour = -1};
      if (face.is_fracture() && face.interface >= 0) {
        for (const std::int32_t owner : owners[face.interface]) {
          if (owner != static_cast<std::int32_t>(n)) tag.neighbour = owner;
        }
      }
      piece.faces.push_back(tag);
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace fracbench
