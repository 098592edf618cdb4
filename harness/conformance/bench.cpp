#include "harness/conformance/bench.h"

#include "geometry/measures.h"
#include "scenarios/given_impact.h"

namespace fracbench::conformance {

std::unique_ptr<Breakable> Bench::prepare(const std::stop_token& stop) const {
  Random random(kSeed);
  StageTimer timer;
  Progress progress;
  Context context = context_of(random, timer, progress, stop);
  return subject_.method.prepare(subject_.target, {}, subject_.options, context);
}

std::vector<Piece> Bench::blow(const Breakable& body, const Impact& impact, std::uint64_t seed,
                               const std::stop_token& stop) const {
  Random random(derive_seed(seed, {"check"}));
  StageTimer timer;
  Progress progress;
  Context context = context_of(random, timer, progress, stop);
  return body.fracture(impact, context);
}

Impact Bench::impact(int n, double factor) const {
  const TriangleMesh& mesh = subject_.target.mesh;
  const std::size_t face =
      (mesh.faces.size() / 7 * static_cast<std::size_t>(3 * n + 1) + 1) % mesh.faces.size();
  const Vec3 point = (mesh.corner(face, 0) + mesh.corner(face, 1) + mesh.corner(face, 2)) / 3;
  return impact_at(subject_.target, point, -area_vector2(mesh, face), factor * subject_.impulse);
}

std::vector<Piece> Bench::broken() const {
  const auto body = prepare();
  std::vector<Piece> pieces;
  for (int n = 0; n < 4 && pieces.size() < 2; ++n) pieces = blow(*body, impact(n));
  return pieces;
}

Context Bench::context_of(Random& random, StageTimer& timer, Progress& progress,
                          const std::stop_token& stop) const {
  return {.random = random,
          .timer = timer,
          .progress = progress,
          .stop = stop,
          .threads = subject_.threads};
}

}  // namespace fracbench::conformance
