#include "harness/summaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "core/error.h"
#include "harness/record_store.h"
#include "harness/study.h"
#include "harness/summary_cache.h"

namespace fracbench {

namespace {

/// Where each label stands in the suite, so that tables have its order.
std::map<std::string, std::size_t> order_of(const nlohmann::ordered_json& suite, const char* kind) {
  std::map<std::string, std::size_t> order;
  for (const auto& item : suite.at(kind).items()) order.emplace(item.key(), order.size());
  return order;
}

}  // namespace

Results read_results(const std::filesystem::path& folder) {
  Results results{.suite = read_stored_suite(folder), .study = {}, .cells = {}, .unreadable = {}};
  SummaryCache cache(folder);
  for (const std::filesystem::path& file : list_records(folder)) {
    try {
      results.cells.push_back(cache.take(file));
    } catch (const DataError& error) {
      results.unreadable.push_back(fmt::format("{}: {}", file.string(), error.what()));
    }
  }
  try {
    results.study = read_study(folder);
  } catch (const InputError& error) {
    results.unreadable.emplace_back(error.what());
  }
  auto shapes = order_of(results.suite.values, "shapes");
  auto methods = order_of(results.suite.values, "methods");
  std::ranges::sort(results.cells, [&](const CellSummary& a, const CellSummary& b) {
    return std::tie(shapes[a.shape], a.family, a.scenario, a.repeat, methods[a.label], a.key) <
           std::tie(shapes[b.shape], b.family, b.scenario, b.repeat, methods[b.label], b.key);
  });
  return results;
}

std::vector<CellSummary> read_summaries(const std::filesystem::path& folder) {
  return read_results(folder).cells;
}

}  // namespace fracbench
