#include "tests/methods/bem/growth_setup.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/random.h"
#include "geometry/measures.h"
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

FractureModel model_with_planes(const PointStress& stress, const std::vector<Start>& starts,
                                const std::vector<Vec3>& planes) {
  FractureModel model = test::model(stress, starts);
  SurfaceStress surface = model.surface_stress({});
  for (std::size_t i = 0; i < planes.size(); ++i) {
    // Falling a little from start to start, so that the cracks keep the order given.
    surface.stress[i] =
        uniaxial(planes[i], 1e7 * (1 - 0.01 * static_cast<double>(i)))(Vec3::Zero());
  }
  model.surface_stress = [surface](std::span<const CrackSheet>) { return surface; };
  return model;
}

PointStress hydrostatic(double tension) {
  return [tension](const Vec3&) -> Mat3 { return tension * Mat3::Identity(); };
}

Propagation run(CutLinks& links, const FractureModel& model, const PropagationOptions& options,
                std::vector<Crack> inherited, int threads) {
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress};
  context.threads = threads;
  return propagate(std::move(inherited), links, StrengthField(StrengthOptions{}), model, options,
                   context);
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

std::string sheet_faults(const Crack& crack, double mesh_size) {
  const TriangleMesh& mesh = crack.sheet.mesh;
  std::map<std::array<std::int32_t, 2>, Vec3> sides;
  double longest = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 normal = area_vector2(mesh, f);
    if (!(normal.norm() > 0)) return "a triangle without area";
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
      if (!sides.emplace(std::array{a, b}, normal.normalized()).second) return "no manifold";
      longest = std::max(longest, (mesh.vertices[a] - mesh.vertices[b]).norm());
    }
  }
  std::size_t boundary_edges = 0;
  for (const auto& [side, normal] : sides) {
    const auto other = sides.find({side[1], side[0]});
    boundary_edges += other == sides.end();
    // A crack may kink by 70 degrees, and the front goes on turning within an edge.
    if (other != sides.end() && normal.dot(other->second) < -0.5) return "a fold";
  }
  const auto& loop = crack.sheet.boundary;
  if (loop.size() != boundary_edges || loop.size() != crack.sheet.states.size()) {
    return "another boundary than its edges";
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (!sides.contains({loop[i], loop[(i + 1) % loop.size()]})) return "a broken boundary";
  }
  if (std::set<std::int32_t>(loop.begin(), loop.end()).size() != loop.size()) {
    return "a boundary that meets itself";
  }
  // Euler: one disc.
  if (mesh.vertices.size() + mesh.faces.size() - (sides.size() + boundary_edges) / 2 != 1) {
    return "no disc";
  }
  // A boundary edge between two markers next to each other cannot be split.
  if (longest > 3 * mesh_size) return "an edge of " + std::to_string(longest);
  return {};
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
