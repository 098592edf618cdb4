#include "tests/methods/cvd/break_body.h"

#include "methods/registry.h"

namespace fracbench::test {

Impact push_at(const Vec3& point) {
  Impulse impulse;
  impulse.point = point;
  impulse.direction = Vec3(1, 0, 0);
  impulse.normal = Vec3(-1, 0, 0);
  impulse.magnitude = 100;
  Impact impact;
  impact.impulses.push_back(impulse);
  return impact;
}

std::vector<Piece> break_body(const TriangleMesh& mesh, const BreakOptions& how) {
  const Method& cvd = find_method("cvd");
  Random random(how.seed);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  context.threads = how.threads;
  const Options options(cvd.options(), how.options, "test");
  return cvd.prepare({"body", mesh, {}}, {}, options, context)
      ->fracture(push_at(mesh.vertices.at(0)), context);
}

}  // namespace fracbench::test
