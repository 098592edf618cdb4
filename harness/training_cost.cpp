#include "harness/training_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/breakable_cache.h"
#include "harness/cost_model.h"

namespace fracbench {

std::string TrainingCost::describe() const {
  return fmt::format("{}: {} training{} of {} fractures, about {}", label, trainings,
                     trainings == 1 ? "" : "s", examples, describe_seconds(seconds));
}

nlohmann::ordered_json TrainingCost::as_json() const {
  return {
      {"method", label}, {"trainings", trainings}, {"examples", examples}, {"seconds", seconds}};
}

std::vector<TrainingCost> training_costs(const Plan& plan, const std::stop_token& stop) {
  if (!plan.suite.learning) return {};
  const TrainingMachine machine{
      .threads = plan.suite.threads_per_cell, .device = plan.suite.device, .stop = stop};
  const auto train = static_cast<std::size_t>(plan.suite.learning->split.train);
  const std::vector<Cell> bodies = bodies_of(plan);
  std::vector<TrainingCost> costs;
  for (std::size_t m = 0; m < plan.methods.size(); ++m) {
    const PlannedMethod& method = plan.methods[m];
    TrainingCost cost{.label = method.label, .examples = train};
    cost.trainings = static_cast<std::size_t>(std::ranges::count(bodies, m, &Cell::method));
    if (cost.trainings > 0 && !method.learn_with.empty()) {
      const auto body = std::ranges::find(bodies, m, &Cell::method);
      std::set<std::string> shapes{plan.shapes[body->shape].label};
      for (const LearnedWith& other : method.learn_with) shapes.insert(other.label);
      cost.examples = train * shapes.size();
      cost.trainings = 1;
    }
    if (cost.trainings == 0) continue;
    const auto one = method.method->learning_seconds(method.options, cost.examples, machine);
    if (!one) continue;
    cost.seconds = static_cast<double>(cost.trainings) * *one;
    costs.push_back(std::move(cost));
  }
  return costs;
}

}  // namespace fracbench
