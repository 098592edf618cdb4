#pragma once

#include <vector>

#include "core/random.h"
#include "metrics/clustered_distance.h"

namespace fracbench::synthetic {

/// A fracture method made up: each collision has a size of its own (log-normal, deviation
/// `between`), each of its fragments scatters about it (log-normal, deviation `within` for what the
/// fragments of one run share and `single` for each of them).
struct CollisionGenerator {
  std::size_t collisions = 40;
  std::size_t fragments = 12;
  double between = 0.4;
  double within = 0.2;
  double single = 0.6;

  /// Collisions are fixed by `impacts`, what the method makes of them by `seed`; `shift` moves all
  /// sizes by that factor.
  Clusters run(std::uint64_t impacts, std::uint64_t seed, double shift = 1) const;
};

/// The mean of each cluster.
std::vector<double> means(const Clusters& clusters);

}  // namespace fracbench::synthetic
