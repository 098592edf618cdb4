#include "harness/learning_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "harness/learning_plan.h"
#include "harness/record_store.h"
#include "harness/stored_suite.h"
#include "harness/terminal_progress.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

/// Room for chance in the number of collisions that is proposed.
constexpr double kMargin = 1.1;

std::string shortage(const LearningShape& shape, const LearningSplit& split) {
  const std::size_t broken = shape.broken();
  const auto needed = static_cast<std::size_t>(split.needed());
  if (broken >= needed) return "";
  const std::size_t all = shape.records.size();
  std::string text = fmt::format(
      "{}: {} of {} collisions broke it ({} unbroken, {} failed), {} are needed ({} to train, {} "
      "to test)",
      shape.label, broken, all, shape.count(LearningRole::unbroken),
      shape.count(LearningRole::failed), needed, split.train, split.test);
  const auto failed = std::ranges::find(shape.records, LearningRole::failed, &LearningRecord::role);
  if (failed != shape.records.end()) {
    text += fmt::format("; {} failed: {}", failed->scenario, failed->reason);
  }
  if (broken + shape.count(LearningRole::unbroken) == 0) return text;
  if (broken == 0) {
    return text +
           "; faster balls may break it, or break_test = \"eq2-patch\" in [learning.scenario] "
           "where the body is light (docs/scenarios.md)";
  }
  const double share = static_cast<double>(broken) / static_cast<double>(all);
  return text + fmt::format(
                    "; raise count to about {:.0f}, in a new folder, or lower train, test "
                    "or least",
                    std::ceil(kMargin * static_cast<double>(needed) / share));
}

/// Everything but the shapes.
Json values_of(const LearningIndex& index) {
  Json json = to_json(index);
  json.erase("shapes");
  return json;
}

/// Adds the shapes that another part of the suite was indexed with.
LearningIndex with_others(LearningIndex index, const Plan& plan,
                          const std::filesystem::path& folder) {
  std::vector<LearningShape> shapes;
  LearningIndex there;
  try {
    there = read_learning_index(folder);
  } catch (const InputError&) {
    return index;  // there is none yet, or it is made anew now
  }
  if (values_of(there) != values_of(index)) return index;
  for (const SuiteShape& entry : plan.suite.shapes) {
    for (LearningIndex* source : {&index, &there}) {
      const auto found = std::ranges::find(source->shapes, entry.label, &LearningShape::label);
      if (found == source->shapes.end()) continue;
      shapes.push_back(std::move(*found));
      break;
    }
  }
  index.shapes = std::move(shapes);
  return index;
}

void update_index(const LearningIndex& index, const Plan& plan,
                  const std::filesystem::path& folder) {
  const RecordStore store(folder);
  const Claim claim = store.wait_for_claim("learning-index");
  write_learning_index(with_others(index, plan, folder), folder);
}

/// More collisions of the same kind begin with those that are there: the folder is made one of the
/// longer suite.
void lengthen(const Plan& plan, const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "suite.json")) return;
  const RecordStore store(folder);
  const Claim claim = store.wait_for_claim("suite");
  const Json there = read_stored_suite(folder).values;
  const Json here = to_json(plan.suite);
  const Json::json_pointer count("/scenarios/" + plan.suite.scenarios.front().label +
                                 "/options/count");
  if (!there.contains(count) || !here.contains(count)) return;
  Json longer = there;
  longer[count] = here[count];
  if (longer == here && there[count] < here[count]) {
    std::filesystem::remove(folder / "suite.json");  // run_suite writes it
  }
}

}  // namespace

LearningResult make_learning_data(const Plan& plan, const LearningSplit& split,
                                  const Catalog& catalog, const RunOptions& options) {
  lengthen(plan, options.folder);
  LearningResult result{.run = run_suite(plan, catalog, options), .index = {}, .shortages = {}};
  if (!result.run.complete()) return result;
  try {
    result.index = index_learning_data(plan, split, options.folder);
  } catch (const DataError& error) {
    throw InputError(fmt::format("{}: a record changed while it was read: {}; run it again",
                                 options.folder.string(), error.what()));
  }
  update_index(*result.index, plan, options.folder);
  for (const LearningShape& shape : result.index->shapes) {
    std::string text = shortage(shape, split);
    if (!text.empty()) result.shortages.push_back(std::move(text));
  }
  return result;
}

bool has_learning_data(const Plan& plan, const std::filesystem::path& folder) {
  LearningIndex index;
  try {
    index = read_learning_index(folder);
  } catch (const InputError&) {
    return false;
  }
  const auto has = [&](const std::string& label, const std::string& digest) {
    if (digest.empty()) return true;
    const auto found = std::ranges::find(index.shapes, label, &LearningShape::label);
    return found != index.shapes.end() && found->digest == digest &&
           shortage(*found, index.split).empty();
  };
  return std::ranges::all_of(
             plan.shapes,
             [&](const PlannedShape& shape) { return has(shape.label, shape.learning_digest); }) &&
         std::ranges::all_of(plan.methods, [&](const PlannedMethod& method) {
           return std::ranges::all_of(method.learn_with, [&](const LearnedWith& other) {
             return has(other.label, other.digest);
           });
         });
}

ExitCode exit_code_of(const LearningResult& result) {
  const bool good = result.index.has_value() && result.shortages.empty();
  return good ? ExitCode::good : ExitCode::not_measured;
}

std::string describe_learning(const RunProgress& progress) {
  const std::size_t broken = progress.done - progress.failed - progress.unbroken;
  std::string text = describe(progress);
  // Behind the share of all.
  const std::size_t at = text.find(" %") + 2;
  return text.insert(at, fmt::format(", {} broken, {} unbroken", broken, progress.unbroken));
}

std::string describe(const LearningShape& shape) {
  return fmt::format(
      "{}: {} of {} collisions broke it: {} train, {} test, {} spare; {} unbroken, {} failed; "
      "largest impulse {:.4g} N s",
      shape.label, shape.broken(), shape.records.size(), shape.count(LearningRole::train),
      shape.count(LearningRole::test), shape.count(LearningRole::spare),
      shape.count(LearningRole::unbroken), shape.count(LearningRole::failed), shape.max_impulse);
}

Json to_json(const LearningResult& result) {
  Json shapes = Json::object();
  if (result.index) {
    for (const LearningShape& shape : result.index->shapes) {
      Json& item = shapes[shape.label] = {{"collisions", shape.records.size()}};
      for (const LearningRole role : kLearningRoles) item[to_string(role)] = shape.count(role);
      item["max_impulse"] = shape.max_impulse;
    }
  }
  return {{"cells", result.run.cells},         {"found", result.run.found},
          {"complete", result.run.complete()}, {"stopped", result.run.stopped},
          {"shortages", result.shortages},     {"shapes", shapes}};
}

}  // namespace fracbench
