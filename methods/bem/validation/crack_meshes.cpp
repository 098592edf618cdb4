#include "methods/bem/validation/crack_meshes.h"

#include <cmath>
#include <numbers>

namespace fracbench::bem {

CrackSheet disc_crack(double radius, int rings, double grading) {
  CrackSheet disc;
  disc.mesh.vertices.push_back(Vec3::Zero());
  const auto first_of = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= rings; ++ring) {
    const double s = static_cast<double>(ring) / rings;
    const double r = radius * (s + grading * (std::sin(std::numbers::pi / 2 * s) - s));
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = 2 * std::numbers::pi * i / (6 * ring);
      disc.mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
    for (int sector = 0; sector < 6; ++sector) {
      const auto outer = [&](int i) { return first_of(ring) + (sector * ring + i) % (6 * ring); };
      const auto inner = [&](int i) {
        return ring == 1 ? 0 : first_of(ring - 1) + (sector * (ring - 1) + i) % (6 * (ring - 1));
      };
      for (int i = 0; i < ring; ++i) {
        disc.mesh.faces.push_back({outer(i), outer(i + 1), inner(i)});
        if (i + 1 < ring) disc.mesh.faces.push_back({outer(i + 1), inner(i + 1), inner(i)});
      }
    }
  }
  for (int i = 0; i < 6 * rings; ++i) disc.boundary.push_back(first_of(rings) + i);
  disc.states.assign(disc.boundary.size(), FrontState::advancing);
  return disc;
}

}  // namespace fracbench::bem
