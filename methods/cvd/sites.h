#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "core/vec3.h"

namespace fracbench::cvd {

/// Points inside a body with the weight of each: a density known by samples.
struct WeightedSamples {
  std::span<const Vec3> points;
  std::vector<double> weights;  ///< parallel, >= 0
};

/// The density exp(-|x - center| / falloff) at the samples; 1 everywhere where falloff is 0.
WeightedSamples density(std::span<const Vec3> points, const Vec3& center, double falloff);

/// `count` different samples, each drawn with a probability in proportion to its weight among those
/// that are left (Efraimidis and Spirakis, "Weighted random sampling with a reservoir", 2006).
/// Needs count <= number of samples.
std::vector<Vec3> draw_sites(const WeightedSamples& samples, std::size_t count, Random& random);

struct Relaxation {
  std::vector<Vec3> sites;
  /// sum over the samples of weight x squared distance to the nearest site, before each iteration
  /// and after the last: never grows.
  std::vector<double> energy;
};

/// Lloyd's iteration: each site moves to the weighted mean of the samples that are nearest to it,
/// which is the centre of mass of its cell restricted to the body. A site without samples stays.
/// (Du, Faber, Gunzburger, "Centroidal Voronoi tessellations: applications and algorithms", SIAM
/// Review 41(4), 1999.) The same result for any number of threads.
Relaxation lloyd(const WeightedSamples& samples, std::vector<Vec3> sites, int iterations,
                 int threads);

}  // namespace fracbench::cvd
