#include "tests/metrics/collision_generator.h"

#include <cmath>
#include <string>

#include "metrics/summary.h"

namespace fracbench::synthetic {

Clusters CollisionGenerator::run(std::uint64_t impacts, std::uint64_t seed, double shift) const {
  Clusters clusters(collisions);
  for (std::size_t c = 0; c < collisions; ++c) {
    Random impact(derive_seed(impacts, {"impact", std::to_string(c)}));
    Random random(derive_seed(seed, {"method", std::to_string(c)}));
    const double size = between * impact.normal() + within * random.normal() + std::log(shift);
    for (std::size_t f = 0; f < fragments; ++f) {
      clusters[c].push_back(std::exp(size + single * random.normal()));
    }
  }
  return clusters;
}

std::vector<double> means(const Clusters& clusters) {
  std::vector<double> list;
  for (const auto& cluster : clusters) list.push_back(summarize(cluster).mean);
  return list;
}

}  // namespace fracbench::synthetic
