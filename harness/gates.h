#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "metrics/paired_permutation.h"

namespace fracbench {

enum class GateTest : std::uint8_t {
  mean,                ///< mean of one value for each collision
  kolmogorov_smirnov,  ///< pooled distribution of a series, such as fragment volumes
  wasserstein,
  paired_ratio,  ///< geometric mean of candidate / baseline: for times
};

/// "mean", "ks", "wasserstein" or "paired-ratio".
std::string_view to_string(GateTest test);

/// What is not allowed to change, and by how much it must change to be called a regression: the
/// change must be both larger than `limit` and significant. One gate judges each method that it
/// applies to by itself.
struct Gate {
  std::string metric;  ///< of docs/metrics.md; "stage_*" stands for every stage
  GateTest test = GateTest::mean;
  std::string method = {};  ///< label in the suite; empty: each
  /// Label of a method whose value for the same collision of the same run the values are divided
  /// by, which makes times of different machines comparable; empty: none.
  std::string relative_to = {};
  std::string shape = {};  ///< label in the suite; empty: all together
  Tail direction = Tail::both;
  /// Smallest change that matters: candidate / baseline where `relative`, else the difference of
  /// means, or the distance of distributions, in the metric's unit.
  double limit = 0;
  bool relative = false;
  double significance = 0.01;   ///< of all gates together
  bool raise_to_noise = false;  ///< rather than be refused
  bool optional = false;        ///< reported, not failed, where there are too few data to judge
  bool built_in = false;        ///< reported, not failed, where the baseline lacks the metric

  bool of_machine() const;  ///< times and memory: only for records of comparable machines
};

/// What is compared where no gates are given; see docs/compare.md.
std::vector<Gate> default_gates();

/// Reads tables [[gate]]. Throws InputError, with file, line and the nearest known key, for
/// anything that is not understood, and for a file without gates.
std::vector<Gate> parse_gates(std::string_view text, const std::filesystem::path& source);
std::vector<Gate> read_gates(const std::filesystem::path& file);

}  // namespace fracbench
