#include "methods/modes/validation/impact_cases.h"

#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "core/sum.h"
#include "geometry/measures.h"
#include "methods/modes/atomic_pieces.h"
#include "methods/modes/cage.h"
#include "methods/modes/impact_projection.h"
#include "methods/modes/model.h"
#include "methods/modes/validation/shapes.h"

namespace fracbench::modes {
namespace {

constexpr double kCriticalImpulse = 4e4;  // N s: 1e7 N for 1/250 s, of the break test `authors`

/// Two cubes joined by a neck, 1.9 m long, in an offset cage, so that the cut is a real one.
struct Dumbbell {
  Target target{"dumbbell", normalized(dumbbell(), 1.9), {}};
  TetMesh tets;
  AtomicPieces pieces;
  std::unique_ptr<ModesBody> body;

  explicit Dumbbell(Context& context) {
    tets =
        tetrahedralise_cage(target.mesh, {.kind = CageKind::offset, .target_faces = 300}, context);
    const FractureModes found = compute_modes(tets, {.count = 3, .dimension = 1}, context);
    pieces = atomic_pieces(target.mesh, tets, found, {.minimum_volume = 1e-3}, context);
    ModelData data;
    data.projection = project_impacts(tets, pieces, context);
    data.typical_jump = typical_jump(data.projection, target.mesh, target.material.density);
    data.cut = pieces.cut;
    body =
        std::make_unique<ModesBody>(std::make_shared<Model>(target, std::move(data), Strength{}));
  }

  /// A blow on the middle of the first face, along its normal.
  Impact blow(double magnitude) const {
    const TriangleMesh& mesh = target.mesh;
    Impulse impulse;
    impulse.point = (mesh.corner(0, 0) + mesh.corner(0, 1) + mesh.corner(0, 2)) / 3;
    impulse.normal = area_vector2(mesh, 0).normalized();
    impulse.direction = -impulse.normal;
    impulse.magnitude = magnitude;
    Impact impact;
    impact.impulses = {impulse};
    impact.overload = magnitude / kCriticalImpulse;
    return impact;
  }
};

std::vector<Accuracy> fragments(Context& context) {
  const Dumbbell made(context);
  const auto pieces = made.body->fracture(made.blow(1e9), context);
  Sum sum;
  for (const Piece& piece : pieces) sum += volume(piece.mesh);
  return {{.name = "volume of all fragments",
           .reference = "that of the body",
           .expected = volume(made.target.mesh),
           .computed = sum.value(),
           .tolerance = 1e-9,
           .unit = "m^3"},
          {.name = "fragments under an unbounded impulse",
           .reference = "the atomic pieces",
           .expected = static_cast<double>(made.pieces.cut.cells.size()),
           .computed = static_cast<double>(pieces.size()),
           .tolerance = 0}};
}

std::vector<Accuracy> critical_impulse_case(Context& context) {
  const Dumbbell made(context);
  double whole = 1e3, broken = 1e7;
  while (broken / whole > 1 + 1e-7) {
    const double middle = std::sqrt(whole * broken);
    (made.body->fracture(made.blow(middle), context).size() > 1 ? broken : whole) = middle;
  }
  return {{.name = "least impulse that breaks",
           .reference = "break test 'authors': 1e7 N over 1/250 s",
           .expected = kCriticalImpulse,
           .computed = broken,
           .tolerance = 1e-6,
           .unit = "N s"}};
}

std::vector<Accuracy> momentum(Context& context) {
  const Dumbbell made(context);
  // Without merging across regions, the pieces' shares of the cage are those of their regions.
  const ImpactProjection projection = project_impacts(made.tets, made.pieces, context);
  std::vector<std::int32_t> all(projection.piece_count());
  std::iota(all.begin(), all.end(), 0);
  const Impact impact = made.blow(1000);
  const double density = 1000;
  const Eigen::MatrixX3d v = piece_velocities(projection, all, impact.impulses, density);
  const double unit = std::pow(projection.frame.size, 3);  // m^3 per unit of volume
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = 0; t < made.tets.tets.size(); ++t) {
    const std::int32_t region = made.pieces.region_of_tet[t];
    for (const std::int32_t p : all) {
      const auto& shares = made.pieces.regions[p];
      if (shares.size() == 1 && shares[0].region == region) {
        sum += density * unit * made.tets.volumes[t] * v.row(p).transpose();
      }
    }
  }
  return {{.name = "momentum of all pieces of the cage",
           .reference = "the impulse",
           .expected = 1000,
           .computed = -sum.dot(impact.impulses[0].normal),
           .tolerance = 1e-9,
           .unit = "N s"}};
}

}  // namespace

std::vector<ValidationCase> impact_validation_cases() {
  return {{"fragments", "the fragments of a dumbbell fill it", 1, fragments},
          {"critical-impulse", "breaks from the break test's impulse on", 1, critical_impulse_case},
          {"momentum", "the impact projection keeps the momentum", 1, momentum}};
}

}  // namespace fracbench::modes
