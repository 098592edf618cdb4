#include "harness/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/digest.h"
#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "harness/build_info.h"
#include "harness/learning_plan.h"
#include "harness/prepared_store.h"

namespace fracbench {

namespace {

/// The entries that `wanted` names by label or name, in the order of the suite.
template <typename Entries, typename NameOf>
Entries kept(const Entries& entries, const std::vector<std::string>& wanted, std::string_view flag,
             const NameOf& name_of) {
  if (wanted.empty()) return entries;
  std::vector<std::string> known;
  for (const auto& entry : entries) {
    known.push_back(entry.label);
    if (name_of(entry) != entry.label) known.push_back(name_of(entry));
  }
  for (const std::string& name : wanted) {
    if (std::ranges::find(known, name) == known.end()) {
      throw InputError(fmt::format("{} {}: the suite does not have it{}", flag, name,
                                   did_you_mean(name, known)));
    }
  }
  Entries result;
  for (const auto& entry : entries) {
    if (keeps(wanted, entry.label, name_of(entry))) result.push_back(entry);
  }
  return result;
}

/// The options of a family with the files that they name found.
Options with_files_found(const Suite& suite, const SuiteScenario& entry,
                         const ScenarioFamily& family) {
  OptionMap values = entry.options.values();
  for (const char* name : {"file", "path"}) {
    const auto found = values.find(name);
    if (found == values.end()) continue;
    if (auto* file = std::get_if<std::string>(&found->second)) {
      *file = find_suite_input(suite, *file).string();
    }
  }
  return Options(family.options(), values, suite.name);
}

/// What a shape is called once it is loaded, wherever its file lies.
std::string target_name(const SuiteShape& shape) {
  const std::string& name = shape.request.name;
  return names_a_file(name) ? std::filesystem::path(name).stem().string() : name;
}

/// The scenes of a shape. They depend on the suite's seed, the shape and the family, so that all
/// methods, repeats and variants of a family's options meet the same random draws.
std::vector<PlannedScenario> make_scenarios(const Suite& suite, const SuiteShape& shape,
                                            const Catalog& catalog) {
  std::vector<PlannedScenario> result;
  for (const SuiteScenario& entry : suite.scenarios) {
    const ScenarioFamily& family = catalog.family(entry.family, suite.name);
    const std::uint64_t seed =
        derive_seed(suite.seed, {"scenes", target_name(shape), entry.family});
    const Options options = with_files_found(suite, entry, family);
    for (Scenario& scenario : family.scenes(options, target_name(shape), seed)) {
      std::string name = entry.label + "-" + scenario.name;
      result.push_back({std::move(name), std::move(scenario)});
    }
  }
  return result;
}

std::vector<PlannedShape> load_shapes(const Suite& suite, const std::vector<SuiteShape>& entries,
                                      const Catalog& catalog) {
  std::vector<PlannedShape> shapes;
  std::vector<std::string> failures;
  for (const SuiteShape& entry : entries) {
    PlannedShape planned{.label = entry.label, .shape = {}, .digest = {}, .scenarios = {}};
    try {
      ShapeRequest request = entry.request;
      if (names_a_file(request.name)) request.name = find_suite_input(suite, request.name).string();
      planned.shape = catalog.load_shape(request);
    } catch (const InputError& error) {
      failures.emplace_back(error.what());
      continue;
    }
    Digest digest;
    digest.add(planned.shape.mesh);
    planned.digest = digest.hex();
    shapes.push_back(std::move(planned));
  }
  if (!failures.empty()) {
    std::string message = fmt::format("{}", fmt::join(failures, "\n"));
    if (!shapes.empty()) {
      std::vector<std::string> labels;
      for (const PlannedShape& shape : shapes) labels.push_back(shape.label);
      message += fmt::format("\nto go on with the others: --shapes {}", fmt::join(labels, ","));
    }
    throw InputError(message);
  }
  return shapes;
}

struct KeyParts {
  const Suite& suite;
  const PlannedShape& shape;
  const std::string& scenario_json;
  const PlannedMethod& method;
  const std::string& options_json;
};

std::string cell_key(const KeyParts& parts, const Cell& cell) {
  Digest digest;
  digest.add(std::string_view("fracbench cell"));
  digest.add(static_cast<std::uint64_t>(kSchemaVersion));
  digest.add(std::string_view(build_info().source_digest));
  digest.add(std::string_view(parts.shape.shape.name));
  digest.add(std::string_view(parts.shape.digest));
  digest.add(std::string_view(parts.scenario_json));
  digest.add(std::string_view(parts.method.info.name));
  digest.add(std::string_view(parts.options_json));
  digest.add(std::string_view(parts.method.info.source_digest));
  if (!parts.method.files_digest.empty()) digest.add(parts.method.files_digest);
  digest.add(static_cast<std::uint64_t>(parts.suite.threads_per_cell));
  if (parts.suite.device != kProcessor) digest.add(std::string_view(parts.suite.device));
  digest.add(cell.seed);
  digest.add(cell.prepare_seed);
  if (parts.method.info.learns) digest.add(std::string_view(parts.shape.learning_digest));
  for (const LearnedWith& other : parts.method.learn_with) {
    digest.add(std::string_view(other.digest));
  }
  return digest.hex();
}

/// Whether group `g` of cells (those that share an impact) is in the shard. The shift by g / count
/// keeps a shard from getting one and the same shape each time.
bool in_shard(std::size_t g, const Shard& shard) {
  const auto count = static_cast<std::size_t>(shard.count);
  return (g + g / count) % count == static_cast<std::size_t>(shard.index - 1);
}

/// What a method is prepared for: a shape, or the shapes that it learns together.
std::string prepared_for(const PlannedShape& shape, const PlannedMethod& method) {
  std::set<std::string> labels{shape.label};
  for (const LearnedWith& other : method.learn_with) labels.insert(other.label);
  return fmt::format("{}", fmt::join(labels, ","));
}

std::vector<Cell> make_cells(const Plan& plan, const Shard& shard) {
  // What goes into many keys is put into text once.
  std::vector<std::vector<std::string>> scenario_json(plan.shapes.size());
  std::size_t rounds = 0;
  for (std::size_t s = 0; s < plan.shapes.size(); ++s) {
    for (const PlannedScenario& planned : plan.shapes[s].scenarios) {
      scenario_json[s].push_back(to_json(planned.scenario).dump());
    }
    rounds = std::max(rounds, scenario_json[s].size());
  }
  std::vector<std::string> options_json;
  for (const PlannedMethod& m : plan.methods) options_json.push_back(m.options.to_json().dump());

  std::vector<Cell> cells;
  std::size_t group = 0;
  for (int repeat = 0; repeat < plan.suite.repeats; ++repeat) {
    for (std::size_t k = 0; k < rounds; ++k) {
      for (std::size_t s = 0; s < plan.shapes.size(); ++s) {
        const PlannedShape& shape = plan.shapes[s];
        if (k >= shape.scenarios.size() || !in_shard(group++, shard)) continue;
        for (std::size_t m = 0; m < plan.methods.size(); ++m) {
          const PlannedMethod& method = plan.methods[m];
          if (!method.breaks(shape.label)) continue;
          Cell cell{.shape = s, .scenario = k, .method = m, .repeat = repeat, .key = {}};
          cell.seed = derive_seed(plan.suite.seed, {"cell", shape.label, shape.scenarios[k].name,
                                                    method.label, std::to_string(repeat)});
          cell.prepare_seed =
              derive_seed(plan.suite.seed, {"prepare", prepared_for(shape, method), method.label});
          cell.key =
              cell_key({plan.suite, shape, scenario_json[s][k], method, options_json[m]}, cell);
          cells.push_back(std::move(cell));
        }
      }
    }
  }
  return cells;
}

/// Says of each shape which learning data its methods get, where one of them learns.
void add_learning_digests(Plan& plan, const Catalog& catalog) {
  std::vector<std::string> labels;
  for (const PlannedMethod& method : plan.methods) {
    if (!method.info.learns) continue;
    if (!plan.suite.learning) {
      throw InputError(
          fmt::format("{}: method '{}' learns, and the suite has no table [learning], which says "
                      "from whose fractures; see docs/learning-data.md",
                      plan.suite.name, method.label));
    }
    const std::vector<std::string>& covered = plan.suite.learning->shapes;
    std::vector<std::string> wanted;
    for (const PlannedShape& shape : plan.shapes) {
      if (method.breaks(shape.label)) wanted.push_back(shape.label);
    }
    for (const LearnedWith& other : method.learn_with) wanted.push_back(other.label);
    for (const std::string& label : wanted) {
      if (std::ranges::find(labels, label) != labels.end()) continue;
      if (!covered.empty() && std::ranges::find(covered, label) == covered.end()) {
        throw InputError(fmt::format(
            "{}: method '{}' learns, and there is no learning data for shape '{}'; add it to the "
            "shapes of [learning], or give the method the key shapes, with those that it breaks",
            plan.suite.name, method.label, label));
      }
      labels.push_back(label);
    }
  }
  if (labels.empty()) return;
  const Plan learning = make_learning_plan(plan.suite, catalog, labels);
  std::map<std::string, std::string> digests;
  for (std::size_t i = 0; i < learning.shapes.size(); ++i) {
    digests[learning.shapes[i].label] = learning_digest(learning, i, plan.suite.learning->split);
  }
  for (PlannedShape& shape : plan.shapes) {
    if (const auto found = digests.find(shape.label); found != digests.end()) {
      shape.learning_digest = found->second;
    }
  }
  for (PlannedMethod& method : plan.methods) {
    for (LearnedWith& other : method.learn_with) other.digest = digests.at(other.label);
  }
}

}  // namespace

bool keeps(const std::vector<std::string>& wanted, const std::string& label,
           const std::string& name) {
  return wanted.empty() || std::ranges::find(wanted, label) != wanted.end() ||
         std::ranges::find(wanted, name) != wanted.end();
}

bool PlannedMethod::breaks(std::string_view shape) const {
  return shapes.empty() || std::ranges::find(shapes, shape) != shapes.end();
}

Shard parse_shard(std::string_view text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, shard.index);
  if (error == std::errc() && slash != end && *slash == '/') {
    const auto [rest, count_error] = std::from_chars(slash + 1, end, shard.count);
    if (count_error == std::errc() && rest == end && 1 <= shard.index &&
        shard.index <= shard.count) {
      return shard;
    }
  }
  throw InputError(fmt::format(
      "--shard {}: must be i/n with i from 1 to n, such as 2/5 for the second of five", text));
}

Plan make_plan(const Suite& suite, const Catalog& catalog, const PlanOptions& options) {
  Plan plan{.suite = suite, .shapes = {}, .methods = {}, .cells = {}};
  for (const SuiteMethod& entry :
       kept(suite.methods, options.methods, "--methods", [](const auto& m) { return m.name; })) {
    const Method& method = catalog.method(entry.name, suite.name);
    MethodInfo info = method.info();
    info.learns = method.learns(entry.options);
    plan.methods.push_back({.label = entry.label,
                            .method = &method,
                            .info = std::move(info),
                            .options = entry.options,
                            .files_digest = digest_of_files(method, entry.options),
                            .limits = entry.limits,
                            .shapes = entry.shapes});
    if (!plan.methods.back().info.learns) continue;
    const std::set<std::string> others(entry.learn_with.begin(), entry.learn_with.end());
    for (const std::string& label : others) {
      plan.methods.back().learn_with.push_back({.label = label, .digest = {}});
    }
  }
  const std::vector<SuiteShape> shapes =
      kept(suite.shapes, options.shapes, "--shapes", [](const auto& s) { return s.request.name; });
  plan.shapes = load_shapes(suite, shapes, catalog);

  std::size_t cells = 0;
  std::size_t next = 0;
  for (const SuiteShape& shape : suite.shapes) {
    std::vector<PlannedScenario> scenarios = make_scenarios(suite, shape, catalog);
    const auto methods = std::ranges::count_if(
        suite.methods, [&](const SuiteMethod& method) { return method.breaks(shape.label); });
    cells += scenarios.size() * static_cast<std::size_t>(methods);
    if (next < plan.shapes.size() && plan.shapes[next].label == shape.label) {
      plan.shapes[next++].scenarios = std::move(scenarios);
    }
  }
  plan.suite_cells = cells * static_cast<std::size_t>(suite.repeats);
  add_learning_digests(plan, catalog);
  plan.cells = make_cells(plan, options.shard);
  return plan;
}

}  // namespace fracbench
