#include "methods/modes/validation/solver_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/adjusted_rand_index.h"
#include "core/sum.h"
#include "geometry/measures.h"
#include "methods/modes/cage.h"
#include "methods/modes/fracture_modes.h"
#include "methods/modes/validation/shapes.h"

namespace fracbench::modes {
namespace {

const std::string kTable = "published: the authors' code with an open conic solver";

struct Solved {
  TetMesh mesh;
  FractureModes modes;
};

Solved solve(const TriangleMesh& shape, int tets, ModesOptions options, Context& context) {
  Solved solved;
  solved.mesh = tetrahedralise_cage(shape, {.kind = CageKind::shape, .target_tets = tets}, context);
  solved.modes = compute_modes(solved.mesh, options, context);
  return solved;
}

/// The faces that a mode opens: their mean place, and the distance of the nearest of their corners
/// from a line along z, both in the shape's frame.
struct Cut {
  Vec3 center = Vec3::Zero();
  double distance = std::numeric_limits<double>::infinity();
  double area = 0;  ///< unit box
};

Cut cut_of(const Solved& solved, int mode, const Vec3& line = Vec3::Zero()) {
  const std::vector<std::int32_t>& piece = solved.modes.pieces[mode];
  Cut cut;
  for (const auto& face : solved.mesh.interior_faces) {
    if (piece[face.tets[0]] == piece[face.tets[1]]) continue;
    cut.area += face.area;
    for (const std::int32_t v : face.corners) {
      const Vec3 x = solved.mesh.frame.to_body(solved.mesh.vertices[v]);
      cut.center += face.area / 3 * x;
      cut.distance = std::min(cut.distance, (x - line).head<2>().norm());
    }
  }
  cut.center /= cut.area;
  return cut;
}

/// How many pieces of a mode have at least this share of the volume.
double large_pieces(const Solved& solved, int mode, double share) {
  std::vector<double> volumes(solved.modes.piece_counts[mode], 0.0);
  for (std::size_t t = 0; t < solved.mesh.tets.size(); ++t) {
    volumes[solved.modes.pieces[mode][t]] += solved.mesh.volumes[t];
  }
  return static_cast<double>(
      std::ranges::count_if(volumes, [&](double v) { return v >= share * solved.mesh.volume(); }));
}

/// 4 p (1 - p) for a mode that leaves a share p of the volume in its first piece: 1 for halves.
double balance(const Solved& solved, int mode) {
  Sum first;
  for (std::size_t t = 0; t < solved.mesh.tets.size(); ++t) {
    if (solved.modes.pieces[mode][t] == 0) first += solved.mesh.volumes[t];
  }
  const double p = first.value() / solved.mesh.volume();
  return 4 * p * (1 - p);
}

/// The energy of a cut of this area into shares p and 1 - p of the volume: the two values that are
/// orthogonal to constants and have unit mass norm differ by 1 / sqrt(V p (1 - p)).
double energy_of_cut(double area, double volume, double p) {
  return area / std::sqrt(volume * p * (1 - p));
}

void add_table_row(std::vector<Accuracy>& rows, const Solved& solved,
                   const std::vector<int>& counts) {
  for (std::size_t k = 0; k < counts.size(); ++k) {
    rows.push_back({.name = fmt::format("pieces of mode {}", k + 1),
                    .reference = kTable,
                    .expected = static_cast<double>(counts[k]),
                    .computed = static_cast<double>(solved.modes.piece_counts[k])});
  }
  rows.push_back({.name = "largest duality gap of the modes",
                  .reference = "0 at the optimum",
                  .expected = 0,
                  .computed = *std::ranges::max_element(solved.modes.gaps),
                  .tolerance = 1e-4});
}

// A cut along the faces of a coarse tet mesh is rough: its area, and with it the energy, is larger
// than that of the plane, by up to an eighth at 2000 tets.
constexpr double kRoughness = 0.125;

std::vector<Accuracy> bar(Context& context) {
  const Solved solved = solve(plain_bar(), 2000, {.count = 1, .dimension = 1}, context);
  return {{.name = "pieces of mode 1",
           .reference = "closed form",
           .expected = 2,
           .computed = static_cast<double>(solved.modes.piece_counts[0])},
          {.name = "balance 4 p (1 - p) of the two halves",
           .reference = "closed form: the middle",
           .expected = 1,
           .computed = balance(solved, 0),
           .tolerance = 0.04},
          {.name = "energy",
           .reference = "closed form: a plane cut in the middle",
           .expected = energy_of_cut(1.0 / 16, 1.0 / 16, 0.5),
           .computed = solved.modes.energies[0],
           .tolerance = kRoughness}};
}

std::vector<Accuracy> neck(Context& context) {
  const Solved solved = solve(dumbbell(), 1900, {.count = 1, .dimension = 1}, context);
  const Cut cut = cut_of(solved, 0);
  const double size = 2.6, volume = 2.18;
  return {{.name = "pieces of mode 1",
           .reference = "closed form",
           .expected = 2,
           .computed = static_cast<double>(solved.modes.piece_counts[0])},
          {.name = "place of the cut, x",
           .reference = "the neck is x = 1 to 1.6",
           .expected = 1.3,
           .computed = cut.center.x(),
           .tolerance = 0.3 / 1.3,
           .unit = "m"},
          {.name = "energy",
           .reference = "closed form: a plane cut through the neck",
           .expected = energy_of_cut(0.3 / std::pow(size, 2), volume / std::pow(size, 3), 0.5),
           .computed = solved.modes.energies[0],
           .tolerance = kRoughness}};
}

std::vector<Accuracy> notch(Context& context) {
  const Solved solved = solve(notched_bar(), 1605, {.count = 6}, context);
  std::vector<Accuracy> rows;
  add_table_row(rows, solved, {2, 2, 2, 3, 3, 3});
  rows.push_back({.name = "place of the first cut, x",
                  .reference = kTable + ": x = 2",
                  .expected = 2,
                  .computed = cut_of(solved, 0).center.x(),
                  .tolerance = 0.06,
                  .unit = "m"});
  rows.push_back({.name = "energy of mode 1",
                  .reference = "closed form: a plane cut at the notch",
                  .expected = energy_of_cut(0.5 / 16, 3.9 / 64, 0.5),
                  .computed = solved.modes.energies[0],
                  .tolerance = kRoughness});
  return rows;
}

std::vector<Accuracy> corner(Context& context) {
  const Solved solved = solve(l_shape(), 1976, {.count = 6}, context);
  std::vector<Accuracy> rows;
  add_table_row(rows, solved, {2, 2, 2, 3, 3, 3});
  rows.push_back({.name = "distance of the first cut from the re-entrant corner",
                  .reference = kTable + ": at the corner",
                  .expected = 0,
                  .computed = cut_of(solved, 0, Vec3(1, 1, 0)).distance,
                  .tolerance = 0.02,
                  .unit = "m"});
  rows.push_back({.name = "energy of mode 1",
                  .reference = "closed form: a plane cut across a leg at the corner",
                  .expected = energy_of_cut(0.5 / 4, 1.5 / 8, 1.0 / 3),
                  .computed = solved.modes.energies[0],
                  .tolerance = kRoughness});
  return rows;
}

std::vector<Accuracy> hole(Context& context) {
  const TriangleMesh plate = plate_with_hole();
  const Solved solved = solve(plate, 1924, {.count = 6}, context);
  std::vector<Accuracy> rows;
  add_table_row(rows, solved, {2, 2, 2});
  // Published for modes 4 to 6: 2, 4 and 4 pieces. The second cut runs across the first, through
  // the other two ligaments. The two halves of a tet mesh are not quite equal, and only a sliver at
  // a ligament makes the second field orthogonal to the first; and each direction has that cut, at
  // half the energy of four quarters.
  rows.push_back({.name = "pieces of mode 4 of at least a tenth of the volume",
                  .reference = kTable,
                  .expected = 2,
                  .computed = large_pieces(solved, 3, 0.1)});
  for (int k = 0; k < 6; k += 3) {
    rows.push_back({.name = fmt::format("energy of mode {}", k + 1),
                    .reference = "closed form: a plane cut through two ligaments",
                    .expected = energy_of_cut(2 * 0.7 * 0.3 / 4, volume(plate) / 8, 0.5),
                    .computed = solved.modes.energies[k],
                    .tolerance = kRoughness});
  }
  rows.push_back({.name = "distance of the first cut from the hole's axis",
                  .reference = kTable + ": the ligaments, from the hole of radius 0.3",
                  .expected = 0.3,
                  .computed = cut_of(solved, 0).distance,
                  .tolerance = 0.02,
                  .unit = "m"});
  return rows;
}

/// The same tets, rotated and numbered in the opposite order.
TetMesh turned_and_renumbered(const TetMesh& mesh) {
  const Mat3 rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<Vec3> vertices;
  for (auto v = mesh.vertices.rbegin(); v != mesh.vertices.rend(); ++v) {
    vertices.push_back(rotation * *v);
  }
  const auto last = static_cast<std::int32_t>(mesh.vertices.size()) - 1;
  std::vector<Tet> tets;
  for (auto t = mesh.tets.rbegin(); t != mesh.tets.rend(); ++t) {
    tets.push_back({last - (*t)[1], last - (*t)[2], last - (*t)[0], last - (*t)[3]});
  }
  return make_tet_mesh(std::move(vertices), std::move(tets), mesh.frame);
}

double agreement(std::vector<std::int32_t> a, const std::vector<std::int32_t>& b) {
  return adjusted_rand_index(a, b);
}

std::vector<Accuracy> invariance(Context& context) {
  const ModesOptions options{.count = 3, .dimension = 1, .gap_tolerance = 1e-5};
  const Solved solved = solve(notched_bar(), 1000, options, context);
  const FractureModes turned = compute_modes(turned_and_renumbered(solved.mesh), options, context);
  TriangleMesh large = notched_bar();
  for (Vec3& v : large.vertices) v = 16 * v + Vec3(8, -4, 2);
  const Solved scaled = solve(large, 1000, options, context);

  std::vector<Accuracy> rows;
  for (int k = 0; k < 3; ++k) {
    const std::vector<std::int32_t> back(turned.pieces[k].rbegin(), turned.pieces[k].rend());
    rows.push_back({.name = fmt::format("energy of mode {} after a rotation, renumbered", k + 1),
                    .reference = "before it",
                    .expected = solved.modes.energies[k],
                    .computed = turned.energies[k],
                    .tolerance = 1e-4});
    rows.push_back(
        {.name = fmt::format("adjusted Rand index of mode {}, rotated, renumbered", k + 1),
         .reference = "before it",
         .expected = 1,
         .computed = agreement(back, solved.modes.pieces[k]),
         .tolerance = 0.02});
    rows.push_back({.name = fmt::format("energy of mode {} of a body 16 times as large", k + 1),
                    .reference = "of the body",
                    .expected = solved.modes.energies[k],
                    .computed = scaled.modes.energies[k],
                    .tolerance = 1e-4});
  }
  return rows;
}

std::vector<Accuracy> elastic(Context& context) {
  const Solved solved = solve(notched_bar(), 400, {.count = 2, .elastic = true}, context);
  std::vector<Accuracy> rows;
  for (int k = 0; k < 2; ++k) {
    rows.push_back({.name = fmt::format("pieces of elastic mode {}", k + 1),
                    .reference = "a hinge at the notch, about either axis",
                    .expected = 2,
                    .computed = static_cast<double>(solved.modes.piece_counts[k])});
    rows.push_back({.name = fmt::format("place of the cut of elastic mode {}, x", k + 1),
                    .reference = "the notch",
                    .expected = 2,
                    .computed = cut_of(solved, k).center.x(),
                    .tolerance = 0.06,
                    .unit = "m"});
  }
  return rows;
}

}  // namespace

std::vector<ValidationCase> solver_validation_cases() {
  return {{"bar", "a plain bar breaks in the middle", 0.3, bar},
          {"dumbbell", "two cubes joined by a neck break at the neck", 0.3, neck},
          {"invariance", "modes do not depend on the frame, the size or the numbering", 0.5,
           invariance},
          {"notched-bar", "reference table: 4 x 1 x 1 bar, notched at x = 2", 0.3, notch},
          {"l-shape", "reference table: two legs 2 x 1 x 0.5", 0.3, corner},
          {"plate-with-hole", "reference table: 2 x 2 x 0.3 plate, hole of radius 0.3", 0.6, hole},
          {"elastic-notched-bar", "elastic modes of the notched bar are hinges at the notch", 2,
           elastic}};
}

}  // namespace fracbench::modes
