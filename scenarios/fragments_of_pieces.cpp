#include "scenarios/fragments_of_pieces.h"

#include "scenarios/replacement.h"

namespace fracbench {

Fragments fragments_of(const TriangleMesh& body, std::vector<Piece> pieces) {
  std::vector<FragmentFace> body_faces(body.faces.size());
  for (std::size_t f = 0; f < body_faces.size(); ++f) {
    body_faces[f].original_face = static_cast<std::int32_t>(f);
  }
  std::int32_t next_interface = 0;
  auto faces = compose_faces(body_faces, pieces, next_interface);
  Fragments fragments;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    fragments.push_back({.mesh = std::move(pieces[k].mesh),
                         .faces = std::move(faces[k]),
                         .piece = static_cast<std::int32_t>(k)});
  }
  return fragments;
}

}  // namespace fracbench
