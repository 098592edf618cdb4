#include "harness/workers/cell_request.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "harness/record_layout.h"
#include "harness/workers/tree_bytes.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

OptionValue option_from(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return json.get<std::vector<double>>();
}

OptionMap options_from(const std::string& text) {
  OptionMap values;
  const Json json = Json::parse(text);
  for (const auto& [name, value] : json.items()) values[name] = option_from(value);
  return values;
}

}  // namespace

std::string encode_job(const Plan& plan, const Cell& cell, std::uint64_t memory) {
  const PlannedShape& shape = plan.shapes[cell.shape];
  const PlannedMethod& method = plan.methods[cell.method];
  DataTree tree;
  tree.put("memory", memory);
  tree.put("suite/name", std::string_view(plan.suite.name));
  tree.put("suite/threads_per_cell", std::int64_t{plan.suite.threads_per_cell});
  tree.put("suite/device", std::string_view(plan.suite.device));
  tree.put("suite/warm_up", std::int64_t{plan.suite.warm_up});
  tree.put("shape/label", std::string_view(shape.label));
  tree.put("shape/digest", std::string_view(shape.digest));
  tree.put("shape/name", std::string_view(shape.shape.name));
  tree.put("shape/notes", std::span<const std::string>(shape.shape.notes));
  put_mesh(tree, "shape/mesh", shape.shape.mesh);
  tree.put("shape/learning_digest", std::string_view(shape.learning_digest));
  tree.put("learning_folder", std::string_view(plan.learning_folder.string()));
  tree.put("method/label", std::string_view(method.label));
  tree.put("method/name", std::string_view(method.info.name));
  tree.put("method/options", std::string_view(method.options.to_json().dump()));
  std::vector<std::string> labels, digests;
  for (const LearnedWith& other : method.learn_with) {
    labels.push_back(other.label);
    digests.push_back(other.digest);
  }
  tree.put("method/learn_with", std::span<const std::string>(labels));
  tree.put("method/learn_with_digests", std::span<const std::string>(digests));
  return to_bytes(tree);
}

WorkerJob decode_job(std::string_view bytes, const Catalog& catalog) {
  const DataTree tree = tree_from_bytes(bytes);
  WorkerJob job;
  job.memory = tree.word("memory");
  job.plan.suite.name = tree.text("suite/name");
  job.plan.suite.threads_per_cell = static_cast<int>(tree.integer("suite/threads_per_cell"));
  job.plan.suite.device = tree.text("suite/device");
  job.plan.suite.warm_up = static_cast<int>(tree.integer("suite/warm_up"));
  job.plan.learning_folder = tree.text("learning_folder");
  job.plan.shapes.push_back({.label = tree.text("shape/label"),
                             .shape = {.name = tree.text("shape/name"),
                                       .mesh = get_mesh(tree, "shape/mesh"),
                                       .notes = tree.texts("shape/notes")},
                             .digest = tree.text("shape/digest"),
                             .scenarios = {},
                             .learning_digest = tree.text("shape/learning_digest")});
  const std::string name = tree.text("method/name");
  const Method& method = catalog.method(name, "worker");
  try {
    Options options(method.options(), options_from(tree.text("method/options")), name);
    MethodInfo info = method.info();
    info.learns = method.learns(options);
    job.plan.methods.push_back({.label = tree.text("method/label"),
                                .method = &method,
                                .info = std::move(info),
                                .options = std::move(options)});
    const std::vector<std::string> labels = tree.texts("method/learn_with");
    const std::vector<std::string> digests = tree.texts("method/learn_with_digests");
    if (labels.size() != digests.size()) throw DataError("has shapes to learn without digests");
    for (std::size_t i = 0; i < labels.size(); ++i) {
      job.plan.methods.back().learn_with.push_back({.label = labels[i], .digest = digests[i]});
    }
  } catch (const Json::exception& error) {
    throw DataError(fmt::format("has options that cannot be read: {}", error.what()));
  }
  return job;
}

std::string encode_cell(const Plan& plan, const Cell& cell) {
  const PlannedScenario& scenario = plan.shapes[cell.shape].scenarios[cell.scenario];
  DataTree tree;
  tree.put("key", std::string_view(cell.key));
  tree.put("repeat", std::int64_t{cell.repeat});
  tree.put("seed", cell.seed);
  tree.put("prepare_seed", cell.prepare_seed);
  tree.put("scenario/name", std::string_view(scenario.name));
  tree.put("scenario/values", std::string_view(to_json(scenario.scenario).dump()));
  return to_bytes(tree);
}

Cell decode_cell(std::string_view bytes, Plan& plan) {
  const DataTree tree = tree_from_bytes(bytes);
  try {
    plan.shapes.at(0).scenarios = {
        {.name = tree.text("scenario/name"),
         .scenario = scenario_from_json(Json::parse(tree.text("scenario/values")))}};
  } catch (const Json::exception& error) {
    throw DataError(fmt::format("has a scene that cannot be read: {}", error.what()));
  }
  return {.repeat = static_cast<int>(tree.integer("repeat")),
          .seed = tree.word("seed"),
          .prepare_seed = tree.word("prepare_seed"),
          .key = tree.text("key")};
}

}  // namespace fracbench
