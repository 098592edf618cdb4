#include "harness/learning_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/digest.h"
#include "core/error.h"
#include "core/random.h"

namespace fracbench {

std::filesystem::path learning_folder_in(const std::filesystem::path& folder) {
  return folder / "learning";
}

Suite learning_suite(const Suite& suite) {
  if (!suite.learning) {
    throw InputError(fmt::format(
        "{}: the suite has no table [learning], which says whose fractures are learned from",
        suite.name));
  }
  const SuiteLearning& learning = *suite.learning;
  Suite result{.name = suite.name + "-learning",
               .summary = fmt::format("learning data of {}", suite.name),
               .seed = learning.seed > 0 ? learning.seed : derive_seed(suite.seed, {"learning"}),
               .threads_per_cell = learning.threads,
               .folder = suite.folder,
               .shapes = suite.shapes,
               .scenarios = {learning.scenario},
               .methods = {learning.method}};
  if (!learning.shapes.empty()) {
    std::erase_if(result.shapes, [&](const SuiteShape& shape) {
      return std::ranges::find(learning.shapes, shape.label) == learning.shapes.end();
    });
  }
  return result;
}

std::vector<std::string> learning_shapes(const Suite& suite, const PlanOptions& part) {
  std::vector<std::string> labels;
  if (!suite.learning) return labels;
  const auto has = [](const std::vector<std::string>& list, const std::string& name) {
    return std::ranges::find(list, name) != list.end();
  };
  const auto learned_with = [&](const std::string& label) {
    return std::ranges::any_of(suite.methods, [&](const SuiteMethod& method) {
      return keeps(part.methods, method.label, method.name) && has(method.learn_with, label);
    });
  };
  const std::vector<std::string>& covered = suite.learning->shapes;
  for (const SuiteShape& shape : suite.shapes) {
    if (!covered.empty() && !has(covered, shape.label)) continue;
    if (keeps(part.shapes, shape.label, shape.request.name) || learned_with(shape.label)) {
      labels.push_back(shape.label);
    }
  }
  return labels;
}

Plan make_learning_plan(const Suite& suite, const Catalog& catalog,
                        const std::vector<std::string>& shapes) {
  const Suite collisions = learning_suite(suite);
  const std::string& name = collisions.methods.front().name;
  if (catalog.method(name, suite.name).info().learns) {
    throw InputError(fmt::format(
        "{}: learning: method '{}' learns itself; name one that computes fractures, such as bem",
        suite.name, name));
  }
  return make_plan(collisions, catalog, {.methods = {}, .shapes = shapes});
}

std::string learning_digest(const Plan& plan, std::size_t shape, const LearningSplit& split) {
  Digest digest;
  digest.add(std::string_view("fracbench learning data"));
  for (const int number : {split.train, split.test, split.needed()}) {
    digest.add(static_cast<std::uint64_t>(number));
  }
  digest.add(plan.suite.seed);  // the division follows from it
  for (const Cell& cell : plan.cells) {
    if (cell.shape == shape) digest.add(std::string_view(cell.key));
  }
  return digest.hex();
}

}  // namespace fracbench
