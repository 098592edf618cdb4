#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/stage_timer.h"
#include "harness/plan.h"

namespace fracbench {

/// How long cells take, from those that were measured. The first of a shape and method also makes
/// the breakable body, which may take longer than all that follow.
class CostModel {
 public:
  /// A cell that took `seconds`, and of them those of its stage "prepare" for its body.
  void add(const std::string& shape, const std::string& label, double seconds,
           std::span<const StageTime> stages);

  /// Of `cells` further ones: as the mean over those of this shape and method, else over those of
  /// the method, whose bodies tell what this one will take; none where the method was never
  /// measured.
  std::optional<double> seconds(const std::string& shape, const std::string& label,
                                std::size_t cells) const;

 private:
  struct Measured {
    double sum = 0;  ///< s, without bodies
    std::size_t count = 0;
    double body = 0;  ///< s, the longest

    double mean() const { return sum / static_cast<double>(count); }
  };
  std::map<std::pair<std::string, std::string>, Measured> by_shape_;
  std::map<std::string, Measured> by_label_;
};

/// What a run would cost.
struct CostEstimate {
  std::size_t cells = 0;
  std::size_t there = 0;    ///< their records exist
  std::size_t unknown = 0;  ///< of those to be measured: nothing like them was ever measured
  double seconds = 0;       ///< for the others, on `jobs` jobs
  int jobs = 1;

  /// "40 cells, 10 of them done; about 3 min for the rest with 2 jobs".
  std::string describe() const;
  /// "cells", "found", "unknown", "seconds" and "jobs".
  nlohmann::ordered_json as_json() const;
};

/// Looks at the records in a results folder, which need not exist.
CostEstimate estimate_cost(const Plan& plan, const std::filesystem::path& folder, int jobs);

/// "45 s", "3 min 20 s", "2 h 5 min", "3 days 4 h".
std::string describe_seconds(double seconds);

}  // namespace fracbench
