#include "harness/cell_pairs.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace fracbench {

namespace {

bool failed(CellStatus status) {
  return status != CellStatus::ok && status != CellStatus::unbroken;
}

void judge_status(const CellPair& pair, CellPairs& result) {
  const CellStatus before = pair.baseline->status;
  const CellStatus after = pair.candidate->status;
  const std::string name = cell_name(*pair.baseline);
  if (before == after) {
    if (failed(after))
      result.still_failing.push_back(fmt::format("{}: {}", name, to_string(after)));
    return;
  }
  std::string line = fmt::format("{}: was {}, is {}", name, to_string(before), to_string(after));
  if (failed(after) && !pair.candidate->reason.empty()) line += ": " + pair.candidate->reason;
  // From whole to broken or back is a change of the scene that nobody asked for, too. One failure
  // in place of another is none, but a crash is worse than an answer that was not accepted.
  const bool repaired = failed(before) && (!failed(after) || after == CellStatus::invalid);
  (repaired ? result.repairs : result.regressions).push_back(line);
}

}  // namespace

std::string cell_name(const CellSummary& cell) {
  std::string name = fmt::format("{}/{}/{}/{}", cell.shape, cell.family, cell.scenario, cell.label);
  if (cell.repeat > 0) name += fmt::format("#{}", cell.repeat);
  return name;
}

CellPairs match_cells(const Results& baseline, const Results& candidate) {
  CellPairs result;
  std::map<std::string, const CellSummary*> candidates;
  for (const CellSummary& cell : candidate.cells) candidates[cell_name(cell)] = &cell;
  std::set<std::string> known;
  for (const CellSummary& cell : baseline.cells) {
    const std::string name = cell_name(cell);
    known.insert(name);
    const auto found = candidates.find(name);
    if (found == candidates.end()) {
      result.missing.push_back(name);
      continue;
    }
    const CellPair pair{&cell, found->second};
    result.pairs.push_back(pair);
    judge_status(pair, result);
    if (cell.impulses != found->second->impulses) ++result.other_impacts;
  }
  for (const auto& [name, cell] : candidates) {
    if (!known.contains(name)) result.added.push_back(name);
  }
  return result;
}

}  // namespace fracbench
