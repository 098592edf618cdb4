#include "reports/accuracy_table.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "harness/build_info.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

TableCell finite_or_nothing(double number) {
  return std::isfinite(number) ? TableCell(number) : TableCell();
}

Json finite_or_null(double number) { return std::isfinite(number) ? Json(number) : Json(nullptr); }

std::string with_unit(const Accuracy& accuracy) {
  if (accuracy.unit.empty()) return accuracy.name;
  return fmt::format("{} [{}]", accuracy.name, accuracy.unit);
}

std::string markdown(const ValidationRun& run, std::string_view method) {
  const Table table = accuracy_table(run, method);
  std::string text = fmt::format("# {}\n\n", table.title);
  for (const std::string& note : table.notes) text += note + "\n\n";
  return text + to_markdown(table);
}

}  // namespace

Table accuracy_table(const ValidationRun& run, std::string_view method) {
  const BuildInfo& build = build_info();
  Table table{
      .name = "accuracy",
      .title = fmt::format("Accuracy of method {}", method),
      .notes = {fmt::format("{} of {} cases; {} of {} values within their tolerance. "
                            "fracbench {} ({}{}).",
                            run.done, run.cases, run.rows.size() - run.failed(), run.rows.size(),
                            build.version, build.revision, build.dirty ? ", with changes" : ""),
                "Error: |computed - reference| / |reference|, or the difference where the "
                "reference is 0."},
      .columns = {
          {"case"}, {"reference"}, {"computed"}, {"error"}, {"tolerance"}, {"pass"}, {"source"}}};
  for (const AccuracyRow& row : run.rows) {
    const Accuracy& a = row.accuracy;
    table.rows.push_back({fmt::format("{}: {}", row.group, with_unit(a)),
                          finite_or_nothing(a.expected), finite_or_nothing(a.computed),
                          finite_or_nothing(a.error()), finite_or_nothing(a.tolerance),
                          std::string(row.pass() ? "yes" : "no"),
                          row.failure.empty() ? a.reference : "failed: " + row.failure});
  }
  return table;
}

Json accuracy_json(const ValidationRun& run) {
  Json list = Json::array();
  for (const AccuracyRow& row : run.rows) {
    const Accuracy& a = row.accuracy;
    Json item = {{"case", a.name},
                 {"reference", finite_or_null(a.expected)},
                 {"computed", finite_or_null(a.computed)},
                 {"error", finite_or_null(a.error())},
                 {"tolerance", finite_or_null(a.tolerance)},
                 {"pass", row.pass()},
                 {"group", row.group},
                 {"unit", a.unit},
                 {"source", a.reference}};
    if (!row.failure.empty()) item["reason"] = row.failure;
    list.push_back(std::move(item));
  }
  return list;
}

void write_accuracy(const ValidationRun& run, std::string_view method,
                    const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw InputError(fmt::format("{}: the folder cannot be made: {}; name another one with --out",
                                 folder.string(), error.message()));
  }
  write_file_atomically(folder / "accuracy.csv", to_csv(accuracy_table(run, method)));
  write_file_atomically(folder / "accuracy.md", markdown(run, method));
}

}  // namespace fracbench
