#pragma once

#include <cstdint>

#include "harness/summaries.h"

namespace fracbench {

/// Results of a method that is made up, with stated variation between and within collisions.
struct MadeUpResults {
  std::size_t collisions = 40;
  int repeats = 1;
  double count = 20;           ///< mean number of fragments
  double count_between = 0.3;  ///< log-normal deviation of it between collisions
  double count_within = 0.1;   ///< and between two runs of one
  double slope_between = 0.3;  ///< of the shape of the distribution of volumes, between collisions
  double slope_within = 0.1;   ///< and between two runs of one
  double time_noise = 0.05;    ///< log-normal deviation of times

  double count_shift = 1;   ///< factor on the number of fragments
  double volume_shift = 0;  ///< added to the logarithm of the exponent of volumes
  double time_shift = 1;    ///< factor on times

  std::uint64_t seed = 1;   ///< of the method; impacts are the same for all seeds
  std::uint64_t rerun = 1;  ///< of the times
  std::string cpu = "a processor";

  Results make() const;
};

}  // namespace fracbench
