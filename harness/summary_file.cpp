#include "harness/summary_file.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/digest.h"
#include "core/error.h"
#include "harness/cell_status.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "fracbench summary";
constexpr int kVersion = 1;

Json to_json(const CellSummary& cell) {
  Json values = Json::array(), series = Json::array(), stages = Json::array();
  for (const MetricValue& v : cell.values) values.push_back({v.name, v.value, v.unit});
  for (const MetricSeries& s : cell.series) series.push_back({s.name, s.values, s.unit});
  for (const StageTime& stage : cell.stages) stages.push_back({stage.name, stage.seconds});
  return {{"key", cell.key},
          {"method", cell.method},
          {"label", cell.label},
          {"method_options", cell.method_options},
          {"shape", cell.shape},
          {"family", cell.family},
          {"scenario", cell.scenario},
          {"repeat", cell.repeat},
          {"seed", cell.seed},
          {"status", to_string(cell.status)},
          {"reason", cell.reason},
          {"values", values},
          {"series", series},
          {"stages", stages},
          {"total_seconds", cell.total_seconds},
          {"prepare_seconds", cell.prepare_seconds},
          {"peak_memory", cell.peak_memory},
          {"threads", cell.threads},
          {"impulses", cell.impulses},
          {"breaks", cell.breaks},
          {"cpu", cell.cpu}};
}

CellSummary cell_from_json(const Json& json) {
  CellSummary cell{.key = json.at("key"),
                   .method = json.at("method"),
                   .label = json.at("label"),
                   .method_options = json.at("method_options"),
                   .shape = json.at("shape"),
                   .family = json.at("family"),
                   .scenario = json.at("scenario"),
                   .repeat = json.at("repeat"),
                   .seed = json.at("seed"),
                   .status = parse_cell_status(json.at("status").get<std::string>()).value(),
                   .reason = json.at("reason"),
                   .values = {},
                   .series = {},
                   .stages = {},
                   .total_seconds = json.at("total_seconds"),
                   .prepare_seconds = json.at("prepare_seconds"),
                   .peak_memory = json.at("peak_memory"),
                   .threads = json.at("threads"),
                   .impulses = json.at("impulses"),
                   .breaks = json.at("breaks"),
                   .cpu = json.at("cpu")};
  for (const Json& v : json.at("values")) cell.values.push_back({v.at(0), v.at(1), v.at(2)});
  for (const Json& s : json.at("series")) cell.series.push_back({s.at(0), s.at(1), s.at(2)});
  for (const Json& s : json.at("stages")) cell.stages.push_back({s.at(0), s.at(1)});
  return cell;
}

}  // namespace

bool names_summary_file(const std::filesystem::path& path) { return path.extension() == ".json"; }

void write_summary_file(const std::filesystem::path& file, const Results& results,
                        const std::vector<Acceptance>& accepted) {
  Json notes = Json::array();
  for (const Acceptance& note : accepted) notes.push_back(to_json(note));
  const Json suite{{"name", results.suite.name},
                   {"summary", results.suite.summary},
                   {"values", results.suite.values},
                   {"cells", results.suite.cells},
                   {"command", results.suite.command}};
  std::string cells;
  for (const CellSummary& cell : results.cells) {
    if (!cells.empty()) cells += ",\n";
    cells += to_json(cell).dump();
  }
  Digest digest;
  digest.add(std::string_view(suite.dump()));
  digest.add(std::string_view(cells));
  write_file_atomically(
      file, fmt::format("{{\"format\": \"{}\", \"version\": {}, \"digest\": \"{}\",\n"
                        "\"accepted\": {},\n\"suite\": {},\n\"cells\": [\n{}\n]}}\n",
                        kFormat, kVersion, digest.hex(), notes.dump(), suite.dump(), cells));
}

SummaryFile read_summary_file(const std::filesystem::path& file) {
  const auto fail = [&](std::string_view what) {
    throw InputError(fmt::format("{}: {}", file.string(), what));
  };
  std::ifstream stream(file);
  if (!stream) fail("cannot be read");
  const Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object() || json.value("format", Json()) != kFormat) {
    fail("is no summary of results; 'fracbench compare FILE.json RESULTS --accept' writes one");
  }
  if (json.value("version", Json()) != kVersion) {
    fail(fmt::format("has version {} of its format, this program reads {}",
                     json.value("version", Json()).dump(), kVersion));
  }
  SummaryFile result;
  try {
    const Json& suite = json.at("suite");
    result.results.suite = {.name = suite.at("name"),
                            .summary = suite.at("summary"),
                            .values = suite.at("values"),
                            .cells = suite.at("cells"),
                            .command = suite.at("command")};
    std::string cells;
    for (const Json& cell : json.at("cells")) {
      result.results.cells.push_back(cell_from_json(cell));
      if (!cells.empty()) cells += ",\n";
      cells += cell.dump();
    }
    for (const Json& note : json.at("accepted")) {
      result.accepted.push_back(acceptance_from_json(note));
    }
    Digest digest;
    digest.add(std::string_view(suite.dump()));
    digest.add(std::string_view(cells));
    if (json.at("digest") == digest.hex()) return result;
  } catch (const nlohmann::json::exception&) {
  } catch (const std::bad_optional_access&) {
  }
  throw InputError(fmt::format("{}: is damaged; restore it, or accept a new baseline",
                               file.string()));
}

}  // namespace fracbench
