#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command.h"
#include "core/error.h"
#include "harness/suite_files.h"
#include "methods/registry.h"
#include "metrics/registry.h"
#include "scenarios/families.h"
#include "scenarios/shapes.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

Json list_methods() {
  Json list = Json::array();
  for (const auto& method : methods()) {
    const MethodInfo info = method->info();
    list.push_back({{"name", info.name},
                    {"summary", info.summary},
                    {"citation", citation(info.publications)},
                    {"shape_type", info.shape_type},
                    {"retains_surface", info.retains_surface},
                    {"refracture", info.refracture},
                    {"random", info.random},
                    {"learns", info.learns},
                    {"volume_tolerance", info.volume_tolerance},
                    {"options", to_json(method->options())}});
  }
  return list;
}

Json list_metrics() {
  Json list = Json::array();
  for (const auto& metric : metrics()) {
    const MetricInfo info = metric->info();
    list.push_back(
        {{"name", info.name}, {"summary", info.summary}, {"of_machine", info.of_machine}});
  }
  return list;
}

Json list_scenarios() {
  Json list = Json::array();
  for (const auto& family : scenario_families()) {
    const FamilyInfo info = family->info();
    list.push_back(
        {{"name", info.name}, {"summary", info.summary}, {"options", to_json(family->options())}});
  }
  return list;
}

Json list_all_shapes() {
  Json list = Json::array();
  for (const ShapeInfo& shape : list_shapes()) {
    Json item = {{"name", shape.name},
                 {"summary", shape.summary},
                 {"source", shape.source},
                 {"available", shape.available}};
    if (!shape.available) item["how_to_get"] = shape.how_to_get;
    list.push_back(item);
  }
  return list;
}

Json list_all_suites() {
  Json list = Json::array();
  for (const SuiteFile& suite : list_suites()) {
    list.push_back(
        {{"name", suite.name}, {"summary", suite.summary}, {"file", suite.file.string()}});
  }
  return list;
}

struct Kind {
  const char* name;
  Json (*list)();
};
constexpr Kind kKinds[] = {{"methods", list_methods},
                           {"metrics", list_metrics},
                           {"scenarios", list_scenarios},
                           {"shapes", list_all_shapes},
                           {"suites", list_all_suites}};

std::string range_of(const Json& option) {
  std::string text;
  if (option.contains("minimum") && option.contains("maximum")) {
    text = fmt::format("{} to {}", option["minimum"].dump(), option["maximum"].dump());
  } else if (option.contains("minimum")) {
    text = fmt::format("at least {}", option["minimum"].dump());
  } else if (option.contains("maximum")) {
    text = fmt::format("at most {}", option["maximum"].dump());
  } else if (option.contains("choices")) {
    for (const auto& choice : option["choices"]) {
      text += (text.empty() ? "" : " | ") + choice.get<std::string>();
    }
  }
  return text;
}

void print_options(const Json& options) {
  for (const Json& option : options) {
    std::string value = option["default"].dump();
    if (option.contains("unit")) value += " " + option["unit"].get<std::string>();
    const std::string range = range_of(option);
    fmt::print("      {} = {}{}  {}\n", option["name"].get<std::string>(), value,
               range.empty() ? "" : " (" + range + ")", option["summary"].get<std::string>());
  }
}

void print_list(const Json& list, bool with_options) {
  std::size_t width = 0;
  for (const Json& item : list) width = std::max(width, item["name"].get<std::string>().size());
  for (const Json& item : list) {
    fmt::print("  {:<{}}  {}\n", item["name"].get<std::string>(), width,
               item["summary"].get<std::string>());
    if (item.contains("how_to_get")) {
      fmt::print("  {:<{}}  not here: {}\n", "", width, item["how_to_get"].get<std::string>());
    }
    if (with_options && item.contains("options")) print_options(item["options"]);
  }
}

ExitCode list(const std::string& what, bool as_json) {
  Json all = Json::object();
  for (const Kind& kind : kKinds) {
    if (!what.empty() && what != kind.name) continue;
    const Json list = kind.list();
    if (!as_json) {
      fmt::print("{}{}\n", all.empty() ? "" : "\n", kind.name);
      print_list(list, !what.empty());
    }
    all[kind.name] = list;
  }
  if (as_json) print_json(what.empty() ? all : all[what]);
  return ExitCode::good;
}

}  // namespace

void add_list_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand("list", "What there is; of one kind, with all options");
  auto what = std::make_shared<std::string>();
  auto as_json = std::make_shared<bool>(false);
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  command->add_option("what", *what, "One kind only")->check(CLI::IsMember(names));
  command->add_flag("--json", *as_json, "As one JSON value");
  command->callback([&chosen, what, as_json] {
    chosen = [what, as_json](std::stop_token) { return list(*what, *as_json); };
  });
}

}  // namespace fracbench
