#include "harness/learning_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "harness/data_file.h"
#include "harness/learning_plan.h"
#include "harness/record.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kIndexVersion = 1;

std::filesystem::path index_file(const std::filesystem::path& folder) {
  return folder / "learning.json";
}

LearningRole role_of(CellStatus status) {
  if (status == CellStatus::ok) return LearningRole::spare;  // until it is divided
  return status == CellStatus::unbroken ? LearningRole::unbroken : LearningRole::failed;
}

LearningRecord read_collision(const std::filesystem::path& file, const std::string& key) {
  const DataTree tree = read_hdf5(file);
  require_intact(tree);
  const CellSummary summary = to_summary(tree);
  if (summary.key != key) throw DataError("is the record of another cell");
  return {.key = key,
          .scenario = summary.scenario,
          .role = role_of(summary.status),
          .status = summary.status,
          .reason = summary.reason,
          .impulses = summary.impulses,
          .result_digest = tree.text("result_digest")};
}

Json to_json(const LearningShape& shape) {
  Json counts;
  for (const LearningRole role : kLearningRoles) counts[to_string(role)] = shape.count(role);
  Json records = Json::array();
  for (const LearningRecord& record : shape.records) {
    Json item{{"file", "records/" + record.key + ".h5"},
              {"scenario", record.scenario},
              {"role", to_string(record.role)},
              {"status", to_string(record.status)},
              {"impulses", record.impulses},
              {"result_digest", record.result_digest}};
    if (!record.reason.empty()) item["reason"] = record.reason;
    records.push_back(std::move(item));
  }
  return {{"name", shape.name},     {"mesh", "shapes/" + shape.mesh_digest + ".h5"},
          {"digest", shape.digest}, {"max_impulse", shape.max_impulse},
          {"counts", counts},       {"records", records}};
}

/// "records/<stem>.h5" without folder and ending.
std::string stem_of(const Json& file) {
  return std::filesystem::path(file.get<std::string>()).stem().string();
}

LearningShape shape_from_json(const std::string& label, const Json& json) {
  LearningShape shape{.label = label,
                      .name = json.at("name"),
                      .mesh_digest = stem_of(json.at("mesh")),
                      .digest = json.at("digest"),
                      .max_impulse = json.at("max_impulse"),
                      .records = {}};
  for (const Json& item : json.at("records")) {
    const auto role = parse_learning_role(item.at("role").get<std::string>());
    const auto status = parse_cell_status(item.at("status").get<std::string>());
    if (!role || !status) throw std::runtime_error("unknown role or status");
    shape.records.push_back({.key = stem_of(item.at("file")),
                             .scenario = item.at("scenario"),
                             .role = *role,
                             .status = *status,
                             .reason = item.value("reason", ""),
                             .impulses = item.at("impulses"),
                             .result_digest = item.at("result_digest")});
  }
  return shape;
}

}  // namespace

std::string_view to_string(LearningRole role) {
  switch (role) {
    case LearningRole::train:
      return "train";
    case LearningRole::test:
      return "test";
    case LearningRole::spare:
      return "spare";
    case LearningRole::unbroken:
      return "unbroken";
    case LearningRole::failed:
      break;
  }
  return "failed";
}

std::optional<LearningRole> parse_learning_role(std::string_view text) {
  for (const LearningRole role : kLearningRoles) {
    if (to_string(role) == text) return role;
  }
  return std::nullopt;
}

std::size_t LearningShape::count(LearningRole role) const {
  return static_cast<std::size_t>(std::ranges::count(records, role, &LearningRecord::role));
}

std::size_t LearningShape::broken() const {
  return count(LearningRole::train) + count(LearningRole::test) + count(LearningRole::spare);
}

std::size_t LearningIndex::count(LearningRole role) const {
  std::size_t sum = 0;
  for (const LearningShape& s : shapes) sum += s.count(role);
  return sum;
}

const LearningShape& LearningIndex::shape(std::string_view label, std::string_view where) const {
  std::vector<std::string> known;
  for (const LearningShape& s : shapes) {
    if (s.label == label) return s;
    known.push_back(s.label);
  }
  throw InputError(fmt::format("{}: holds no learning data of shape '{}'{}", where, label,
                               did_you_mean(label, known)));
}

void divide(LearningShape& shape, const LearningSplit& split, std::uint64_t seed) {
  using Ranked = std::pair<std::uint64_t, LearningRecord*>;
  std::vector<Ranked> broken;
  for (LearningRecord& record : shape.records) {
    if (record.status != CellStatus::ok) continue;
    broken.push_back(
        {derive_seed(seed, {"learning split", shape.label, record.scenario}), &record});
  }
  std::ranges::stable_sort(broken, {}, &Ranked::first);
  const auto wanted = static_cast<std::size_t>(split.wanted());
  const std::size_t used = std::min(broken.size(), wanted);
  const double share = static_cast<double>(split.test) / split.wanted();
  const auto tests = static_cast<std::size_t>(std::lround(share * static_cast<double>(used)));
  for (std::size_t i = 0; i < broken.size(); ++i) {
    broken[i].second->role = i < tests  ? LearningRole::test
                             : i < used ? LearningRole::train
                                        : LearningRole::spare;
  }
}

LearningIndex index_learning_data(const Plan& plan, const LearningSplit& split,
                                  const std::filesystem::path& folder) {
  const PlannedMethod& method = plan.methods.front();
  LearningIndex index{.suite = plan.suite.name,
                      .method = method.info.name,
                      .method_options = method.options.to_json().dump(),
                      .family = plan.suite.scenarios.front().family,
                      .seed = plan.suite.seed,
                      .split = split,
                      .shapes = {}};
  for (std::size_t s = 0; s < plan.shapes.size(); ++s) {
    index.shapes.push_back({.label = plan.shapes[s].label,
                            .name = plan.shapes[s].shape.name,
                            .mesh_digest = plan.shapes[s].digest,
                            .digest = learning_digest(plan, s, split),
                            .records = {}});
  }
  for (const Cell& cell : plan.cells) {
    LearningShape& shape = index.shapes[cell.shape];
    shape.records.push_back(
        read_collision(folder / "records" / fmt::format("{}.h5", cell.key), cell.key));
    const LearningRecord& record = shape.records.back();
    if (record.role == LearningRole::failed) continue;
    for (const double impulse : record.impulses) {
      shape.max_impulse = std::max(shape.max_impulse, impulse);
    }
  }
  for (LearningShape& shape : index.shapes) divide(shape, split, index.seed);
  return index;
}

Json to_json(const LearningIndex& index) {
  Json shapes = Json::object();
  for (const LearningShape& shape : index.shapes) shapes[shape.label] = to_json(shape);
  return {{"version", kIndexVersion},      {"suite", index.suite},
          {"method", index.method},        {"method_options", Json::parse(index.method_options)},
          {"family", index.family},        {"seed", index.seed},
          {"train", index.split.train},    {"test", index.split.test},
          {"least", index.split.needed()}, {"shapes", shapes}};
}

LearningIndex learning_index_from_json(const Json& json, std::string_view where) {
  std::string trouble;
  try {
    if (json.at("version") != kIndexVersion) throw std::runtime_error("of another version");
    LearningIndex index{
        .suite = json.at("suite"),
        .method = json.at("method"),
        .method_options = json.at("method_options").dump(),
        .family = json.at("family"),
        .seed = json.at("seed"),
        .split = {.train = json.at("train"), .test = json.at("test"), .least = json.at("least")},
        .shapes = {}};
    for (const auto& item : json.at("shapes").items()) {
      index.shapes.push_back(shape_from_json(item.key(), item.value()));
    }
    return index;
  } catch (const std::exception& error) {
    trouble = error.what();
  }
  throw InputError(fmt::format(
      "{}: is no index of learning data ({}); fracbench prepare makes it anew from the records",
      where, trouble));
}

void write_learning_index(const LearningIndex& index, const std::filesystem::path& folder) {
  write_file_atomically(index_file(folder), to_json(index).dump(1) + "\n");
}

LearningIndex read_learning_index(const std::filesystem::path& folder) {
  const std::filesystem::path file = index_file(folder);
  std::ifstream stream(file);
  if (!stream) {
    throw InputError(fmt::format(
        "{}: is missing; make the learning data, or only its index, with fracbench prepare SUITE",
        file.string()));
  }
  return learning_index_from_json(Json::parse(stream, nullptr, false), file.string());
}

}  // namespace fracbench
