#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "harness/plan.h"

namespace fracbench {

/// What one method of a plan takes to learn, where nothing of it is kept from before.
struct TrainingCost {
  std::string label;          ///< of the method
  std::size_t trainings = 0;  ///< one for each body, or for all shapes that are learned together
  std::size_t examples = 0;   ///< fractures that one of them learns from, at most
  double seconds = 0;         ///< of all of them, one after the other

  /// "deepfracture: 2 trainings of 16 fractures, about 3 min 20 s".
  std::string describe() const;
  /// "method", "trainings", "examples" and "seconds".
  nlohmann::ordered_json as_json() const;
};

/// Asks the methods that learn for long, which takes some seconds for each
/// (Method::learning_seconds). Throws what that throws.
std::vector<TrainingCost> training_costs(const Plan& plan, const std::stop_token& stop);

}  // namespace fracbench
