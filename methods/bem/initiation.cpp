#include "methods/bem/initiation.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geometry/measures.h"

namespace fracbench::bem {
namespace {

CrackSeed judge(const SurfaceStress& surface, std::size_t element, double strength,
                const InitiationOptions& options) {
  const Mat3& stress = surface.stress[element];
  if (!stress.allFinite()) {
    throw MethodFailure(fmt::format("the stress of surface element {} is no number", element));
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(stress);
  const Vec3 s = principal.eigenvalues();  // ascending
  CrackSeed seed;
  seed.element = element;
  seed.position = surface.centers[element];
  seed.surface_normal = surface.normals[element];
  const double tension = s[2];
  const double compression = -s[0] / (options.parity ? 1 : options.compressive_factor);
  seed.compressed = compression > tension;
  const int direction = seed.compressed ? 0 : 2;
  seed.stress = s[direction];
  seed.excess = std::max(tension, compression) / strength;
  seed.normal = principal.eigenvectors().col(direction);
  // An eigenvector has no sign of its own: the largest component is made positive.
  int largest = 0;
  seed.normal.cwiseAbs().maxCoeff(&largest);
  if (seed.normal[largest] < 0) seed.normal = -seed.normal;
  return seed;
}

}  // namespace

SurfaceStress surface_stress(const TriangleMesh& mesh, std::vector<Mat3> stress) {
  if (stress.size() != mesh.faces.size()) {
    throw InputError(fmt::format("{} stresses for a surface of {} triangles: give one for each",
                                 stress.size(), mesh.faces.size()));
  }
  SurfaceStress surface;
  surface.stress = std::move(stress);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    surface.centers.push_back((mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3);
    surface.normals.push_back(area_vector2(mesh, f).normalized());
  }
  return surface;
}

std::vector<CrackSeed> initiate(const SurfaceStress& surface, const StrengthField& strength,
                                std::span<const Vec3> occupied, const InitiationOptions& options) {
  const std::size_t count = surface.stress.size();
  if (surface.centers.size() != count || surface.normals.size() != count) {
    throw InputError(fmt::format("{} stresses, {} centres and {} normals of surface elements",
                                 count, surface.centers.size(), surface.normals.size()));
  }
  if (!(options.compressive_factor > 0)) {
    throw InputError(
        fmt::format("compressive factor {}: it must be above 0", options.compressive_factor));
  }
  std::vector<CrackSeed> candidates;
  for (std::size_t e = 0; e < count; ++e) {
    CrackSeed seed = judge(surface, e, strength.at(surface.centers[e]), options);
    if (seed.excess > 1) candidates.push_back(seed);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const CrackSeed& a, const CrackSeed& b) { return a.excess > b.excess; });
  const double nearest2 = options.min_distance * options.min_distance;
  const auto apart = [&](const Vec3& a, const Vec3& b) {
    return (a - b).squaredNorm() >= nearest2;
  };
  std::vector<CrackSeed> seeds;
  for (const CrackSeed& seed : candidates) {
    if (static_cast<int>(seeds.size()) >= options.max_cracks) break;
    const bool free = std::all_of(occupied.begin(), occupied.end(),
                                  [&](const Vec3& point) { return apart(point, seed.position); }) &&
                      std::all_of(seeds.begin(), seeds.end(), [&](const CrackSeed& other) {
                        return apart(other.position, seed.position);
                      });
    if (free) seeds.push_back(seed);
  }
  return seeds;
}

}  // namespace fracbench::bem
