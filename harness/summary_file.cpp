#include "harness/summary_file.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/digest.h"
#include "core/error.h"
#include "harness/cell_summary_json.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "fracbench summary";
constexpr int kVersion = 1;

/// Over the suite and the cells, as they stand in the file.
std::string digest_of(const Json& suite, std::string_view cells) {
  Digest digest;
  digest.add(std::string_view(suite.dump()));
  digest.add(cells);
  return digest.hex();
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
  write_file_atomically(
      file,
      fmt::format("{{\"format\": \"{}\", \"version\": {}, \"digest\": \"{}\",\n"
                  "\"accepted\": {},\n\"suite\": {},\n\"cells\": [\n{}\n]}}\n",
                  kFormat, kVersion, digest_of(suite, cells), notes.dump(), suite.dump(), cells));
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
      result.results.cells.push_back(cell_summary_from_json(cell));
      if (!cells.empty()) cells += ",\n";
      cells += cell.dump();
    }
    for (const Json& note : json.at("accepted")) {
      result.accepted.push_back(acceptance_from_json(note));
    }
    if (json.at("digest") == digest_of(suite, cells)) return result;
  } catch (const nlohmann::json::exception&) {
  } catch (const std::bad_optional_access&) {
  }
  throw InputError(
      fmt::format("{}: is damaged; restore it, or accept a new baseline", file.string()));
}

}  // namespace fracbench
