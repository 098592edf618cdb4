#include "tests/methods/bem/growth_setup.h"

#include <algorithm>

#include "core/random.h"
#include "methods/bem/fast_model.h"
#include "methods/bem/growth_law.h"
#include "tests/methods/cvd/bodies.h"

namespace fracbench::test {

using namespace bem;

PointStress uniaxial(const Vec3& direction, double tension) {
  const Mat3 stress = tension * direction.normalized() * direction.normalized().transpose();
  return [stress](const Vec3&) { return stress; };
}

TriangleMesh box(const Vec3& extent) {
  TriangleMesh mesh = cube(4);
  for (Vec3& v : mesh.vertices) v = v.cwiseProduct(0.5 * extent);
  return mesh;
}

FractureModel model(const PointStress& stress, const std::vector<Start>& starts) {
  SurfaceStress surface;
  for (const Start& start : starts) {
    surface.centers.push_back(start.position);
    surface.normals.push_back(start.normal);
    surface.stress.push_back(stress(start.position));
  }
  FractureModel model;
  model.surface_stress = [surface](std::span<const CrackSheet>) { return surface; };
  model.stress_intensity = fast_model(
      [stress](std::span<const Vec3> points) {
        std::vector<Mat3> stresses;
        for (const Vec3& p : points) stresses.push_back(stress(p));
        return stresses;
      },
      FastFactors::authors(), Material{}.compressive_factor);
  return model;
}

Propagation run(CutLinks& links, const FractureModel& model, const PropagationOptions& options,
                int threads) {
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  context.threads = threads;
  return propagate({}, links, StrengthField(StrengthOptions{}), model, options, context);
}

PropagationOptions long_run(double mesh_size, int max_cracks) {
  PropagationOptions options;
  options.mesh_size = mesh_size;
  options.max_cracks = max_cracks;
  options.duration = 4 / rayleigh_speed(options.material);
  return options;
}

std::vector<double> parts(const CutLinks& links) {
  std::map<std::int32_t, double> sizes;
  double all = 0;
  for (const std::int32_t c : links.components().values) {
    if (c == 0) continue;
    sizes[c] += 1;
    all += 1;
  }
  std::vector<double> shares;
  for (const auto& [component, size] : sizes) shares.push_back(size / all);
  std::sort(shares.rbegin(), shares.rend());
  return shares;
}

std::string bytes(const Propagation& result) {
  std::string all;
  const auto add = [&](const auto& value) {
    all.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (const Crack& crack : result.cracks) {
    for (const TriangleMesh* mesh : {&crack.surface, &crack.sheet.mesh}) {
      for (const Vec3& v : mesh->vertices) add(v);
      for (const Face& f : mesh->faces) add(f);
    }
    for (const FrontMarker& m : crack.front) {
      add(m.position);
      add(m.forward);
      add(m.speed);
      add(m.state);
    }
  }
  add(result.report.area);
  add(result.report.time);
  return all;
}

}  // namespace fracbench::test
