#include "harness/record.h"

#include <fmt/format.h>

#include "harness/plan.h"
#include "harness/record_layout.h"

namespace fracbench {

namespace {

/// The arrays below a prefix, without it.
DataTree subtree(const DataTree& tree, std::string_view prefix) {
  DataTree result;
  for (const auto& [path, array] : tree.arrays()) {
    if (path.starts_with(prefix)) result.put_array(path.substr(prefix.size()), array);
  }
  return result;
}

void put_subtree(DataTree& tree, std::string_view prefix, const DataTree& part) {
  for (const auto& [path, array] : part.arrays()) {
    tree.put_array(std::string(prefix) + path, array);
  }
}

DataTree result_tree(const Record& record) {
  DataTree tree;
  const CellIdentity& id = record.identity;
  tree.put("identity/method", std::string_view(id.method));
  tree.put("identity/label", std::string_view(id.label));
  tree.put("identity/method_options", std::string_view(id.method_options));
  tree.put("identity/method_digest", std::string_view(id.method_digest));
  tree.put("identity/shape", std::string_view(id.shape));
  tree.put("identity/shape_digest", std::string_view(id.shape_digest));
  tree.put("identity/family", std::string_view(id.family));
  tree.put("identity/scenario", std::string_view(id.scenario));
  tree.put("identity/scenario_values", std::string_view(id.scenario_values));
  tree.put("identity/repeat", std::int64_t{id.repeat});
  tree.put("identity/seed", id.seed);
  tree.put("identity/prepare_seed", id.prepare_seed);
  tree.put("identity/threads", std::int64_t{id.threads});
  tree.put("identity/source_digest", std::string_view(id.source_digest));
  const CellOutcome& outcome = record.outcome;
  tree.put("status", to_string(outcome.status));
  tree.put("reason", std::string_view(outcome.reason));
  tree.put("notes", std::span<const std::string>(outcome.notes));
  const SceneResult& scene = outcome.scene;
  put_impacts(tree, "impacts", scene.impacts);
  std::vector<Impact> unbroken;
  if (scene.unbroken) unbroken.push_back(*scene.unbroken);
  put_impacts(tree, "unbroken", unbroken);
  put_fragments(tree, "fragments", scene.impacts.empty() ? Fragments() : scene.fragments);
  put_trajectory(tree, "trajectory", scene.trajectory);
  put_replacements(tree, "replacements", scene.replacements);
  put_measurement(tree, "metrics", outcome.measurement);
  return tree;
}

DataTree machine_tree(const CellCost& cost) {
  DataTree tree;
  std::vector<std::string> names;
  std::vector<double> seconds;
  for (const StageTime& stage : cost.stages) {
    names.push_back(stage.name);
    seconds.push_back(stage.seconds);
  }
  tree.put("stage_names", names);
  tree.put("stage_seconds", seconds);
  tree.put("total_seconds", cost.total_seconds);
  tree.put("prepare_seconds", cost.prepare_seconds);
  tree.put("peak_memory", cost.peak_memory);
  put_measurement(tree, "metrics", cost.measurement);
  for (const auto& [name, value] : cost.provenance) {
    tree.put("provenance/" + name, std::string_view(value));
  }
  return tree;
}

CellIdentity get_identity(const DataTree& tree) {
  return {.method = tree.text("identity/method"),
          .label = tree.text("identity/label"),
          .method_options = tree.text("identity/method_options"),
          .method_digest = tree.text("identity/method_digest"),
          .shape = tree.text("identity/shape"),
          .shape_digest = tree.text("identity/shape_digest"),
          .family = tree.text("identity/family"),
          .scenario = tree.text("identity/scenario"),
          .scenario_values = tree.text("identity/scenario_values"),
          .repeat = static_cast<int>(tree.integer("identity/repeat")),
          .seed = tree.word("identity/seed"),
          .prepare_seed = tree.word("identity/prepare_seed"),
          .threads = static_cast<int>(tree.integer("identity/threads")),
          .source_digest = tree.text("identity/source_digest")};
}

/// Everything but fragments and trajectory.
CellOutcome get_outcome(const DataTree& tree) {
  CellOutcome outcome;
  const std::string status = tree.text("status");
  const auto known = parse_cell_status(status);
  if (!known) throw DataError(fmt::format("unknown status '{}'", status));
  outcome.status = *known;
  outcome.reason = tree.text("reason");
  outcome.notes = tree.texts("notes");
  outcome.scene.impacts = get_impacts(tree, "impacts");
  const std::vector<Impact> unbroken = get_impacts(tree, "unbroken");
  if (!unbroken.empty()) outcome.scene.unbroken = unbroken.front();
  outcome.measurement = get_measurement(tree, "metrics");
  return outcome;
}

CellCost get_cost(const DataTree& tree) {
  CellCost cost;
  const auto names = tree.texts("stage_names");
  const auto seconds = tree.reals("stage_seconds");
  if (names.size() != seconds.size()) throw DataError("stage names and times do not fit");
  for (std::size_t i = 0; i < names.size(); ++i) cost.stages.push_back({names[i], seconds[i]});
  cost.total_seconds = tree.real("total_seconds");
  cost.prepare_seconds = tree.real("prepare_seconds");
  cost.peak_memory = tree.real("peak_memory");
  cost.measurement = get_measurement(tree, "metrics");
  constexpr std::string_view kProvenance = "provenance/";
  for (const auto& [path, array] : tree.arrays()) {
    if (path.starts_with(kProvenance)) {
      cost.provenance[path.substr(kProvenance.size())] = tree.text(path);
    }
  }
  return cost;
}

void require_version(const DataTree& tree) {
  const std::int64_t version = tree.integer("schema_version");
  if (version != kSchemaVersion) {
    throw DataError(fmt::format("has layout version {}, this program reads version {}", version,
                                kSchemaVersion));
  }
}

void require_digest(const DataTree& tree, std::string_view name, const DataTree& part) {
  if (tree.text(name) != part.digest()) {
    throw DataError(fmt::format("is damaged: {} does not match", name));
  }
}

}  // namespace

DataTree to_tree(const Record& record) {
  const DataTree result = result_tree(record);
  const DataTree machine = machine_tree(record.cost);
  DataTree tree;
  tree.put("schema_version", std::int64_t{kSchemaVersion});
  tree.put("key", std::string_view(record.key));
  tree.put("result_digest", std::string_view(result.digest()));
  tree.put("machine_digest", std::string_view(machine.digest()));
  put_subtree(tree, "result/", result);
  put_subtree(tree, "machine/", machine);
  return tree;
}

Record to_record(const DataTree& tree) {
  require_version(tree);
  const DataTree result = subtree(tree, "result/");
  const DataTree machine = subtree(tree, "machine/");
  require_digest(tree, "result_digest", result);
  require_digest(tree, "machine_digest", machine);
  Record record{.key = tree.text("key"),
                .identity = get_identity(result),
                .outcome = get_outcome(result),
                .cost = get_cost(machine)};
  record.outcome.scene.fragments = get_fragments(result, "fragments");
  record.outcome.scene.trajectory = get_trajectory(result, "trajectory");
  record.outcome.scene.replacements = get_replacements(result, "replacements");
  return record;
}

void require_intact(const DataTree& tree) {
  require_version(tree);
  require_digest(tree, "result_digest", subtree(tree, "result/"));
  require_digest(tree, "machine_digest", subtree(tree, "machine/"));
}

std::string result_digest(const Record& record) { return result_tree(record).digest(); }

bool is_summary_array(std::string_view path) {
  return !path.starts_with("result/fragments/") && !path.starts_with("result/trajectory/");
}

bool is_packed_array(std::string_view path) { return path != "result/trajectory/poses"; }

CellSummary to_summary(const DataTree& tree) {
  require_version(tree);
  const DataTree result = subtree(tree, "result/");
  CellSummary summary = to_summary({.key = tree.text("key"),
                                    .identity = get_identity(result),
                                    .outcome = get_outcome(result),
                                    .cost = get_cost(subtree(tree, "machine/"))});
  summary.result_digest = tree.text("result_digest");
  return summary;
}

CellSummary to_summary(const Record& record) {
  const auto& [key, identity, outcome, cost] = record;
  const auto cpu = cost.provenance.find("cpu");
  CellSummary summary{.key = key,
                      .method = identity.method,
                      .label = identity.label,
                      .method_options = identity.method_options,
                      .shape = identity.shape,
                      .family = identity.family,
                      .scenario = identity.scenario,
                      .repeat = identity.repeat,
                      .seed = identity.seed,
                      .status = outcome.status,
                      .reason = outcome.reason,
                      .values = outcome.measurement.values,
                      .series = outcome.measurement.series,
                      .stages = cost.stages,
                      .total_seconds = cost.total_seconds,
                      .prepare_seconds = cost.prepare_seconds,
                      .peak_memory = cost.peak_memory,
                      .threads = identity.threads,
                      .impulses = {},
                      .breaks = static_cast<int>(outcome.scene.impacts.size()),
                      .cpu = cpu == cost.provenance.end() ? "" : cpu->second};
  for (const MetricValue& value : cost.measurement.values) summary.values.push_back(value);
  for (const MetricSeries& series : cost.measurement.series) summary.series.push_back(series);
  const SceneResult& scene = outcome.scene;
  if (!scene.impacts.empty() || scene.unbroken) {
    const Impact& impact = scene.impacts.empty() ? *scene.unbroken : scene.impacts.front();
    for (const Impulse& impulse : impact.impulses) summary.impulses.push_back(impulse.magnitude);
  }
  return summary;
}

}  // namespace fracbench
