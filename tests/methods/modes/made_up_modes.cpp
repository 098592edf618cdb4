#include "tests/methods/modes/made_up_modes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fracbench::test {

modes::FractureModes made_up_modes(const modes::TetMesh& tets,
                                   std::vector<std::vector<std::int32_t>> pieces) {
  modes::FractureModes found;
  found.dimension = 1;
  const auto count = static_cast<Eigen::Index>(tets.tets.size());
  found.displacement.resize(count, std::ssize(pieces));
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    double norm2 = 0;
    for (std::size_t t = 0; t < tets.tets.size(); ++t) {
      norm2 += tets.volumes[t] * pieces[k][t] * pieces[k][t];
    }
    for (std::size_t t = 0; t < tets.tets.size(); ++t) {
      found.displacement(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) =
          pieces[k][t] / std::sqrt(norm2);
    }
    double energy = 0;
    for (const auto& face : tets.interior_faces) {
      energy +=
          face.area * std::abs(found.displacement(face.tets[0], static_cast<Eigen::Index>(k)) -
                               found.displacement(face.tets[1], static_cast<Eigen::Index>(k)));
    }
    found.energies.push_back(energy);
    found.piece_counts.push_back(1 + *std::ranges::max_element(pieces[k]));
  }
  found.pieces = std::move(pieces);
  return found;
}

Bar bar() {
  const Vec3 low(-2, -0.5, -0.5), high(2, 0.5, 0.5);
  Bar result;
  result.tets = tet_block({8, 2, 2}, low, high);
  result.target.name = "bar";
  result.target.mesh = surface_of(tet_block({4, 1, 1}, low, high));
  result.found = made_up_modes(result.tets, {slabs(result.tets, 2), slabs(result.tets, 4)});
  return result;
}

modes::ModelData model_data(const Target& target, const modes::TetMesh& tets,
                            const modes::FractureModes& found, const modes::MergeOptions& merge) {
  Surroundings surroundings;
  Context context = surroundings.context();
  modes::AtomicPieces pieces = modes::atomic_pieces(target.mesh, tets, found, merge, context);
  modes::ModelData data;
  data.projection = modes::project_impacts(tets, pieces, context);
  data.typical_jump = modes::typical_jump(data.projection, target.mesh, target.material.density);
  data.cut = std::move(pieces.cut);
  data.mode_energies = found.energies;
  data.mode_pieces = found.piece_counts;
  data.settings = "by hand";
  return data;
}

}  // namespace fracbench::test
