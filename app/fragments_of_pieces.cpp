#include "app/fragments_of_pieces.h"

#include <algorithm>

namespace fracbench {

Fragments fragments_of(std::vector<Piece> pieces) {
  Fragments fragments;
  const auto count = static_cast<std::int32_t>(pieces.size());
  for (std::int32_t k = 0; k < count; ++k) {
    Fragment fragment{.mesh = std::move(pieces[k].mesh), .faces = {}, .piece = k};
    for (const PieceFace& face : pieces[k].faces) {
      if (!face.is_fracture()) {
        fragment.faces.push_back({.original_face = face.parent_face, .interface = -1});
      } else if (face.neighbour < 0) {
        fragment.faces.push_back({.original_face = -1, .interface = -1});
      } else {
        // The same number from both sides.
        const auto [low, high] = std::minmax(k, face.neighbour);
        fragment.faces.push_back({.original_face = -1, .interface = low * count + high});
      }
    }
    fragments.push_back(std::move(fragment));
  }
  return fragments;
}

}  // namespace fracbench
