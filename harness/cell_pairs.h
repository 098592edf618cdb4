#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/summaries.h"

namespace fracbench {

/// The same cell of two runs: same shape, impact, method and repeat, made from the same seeds.
struct CellPair {
  const CellSummary* baseline = nullptr;
  const CellSummary* candidate = nullptr;
};

/// The cells of two results folders of one suite, matched. Points into both.
struct CellPairs {
  std::vector<CellPair> pairs;             ///< in the order of the baseline
  std::vector<std::string> missing;        ///< cells that only the baseline has
  std::vector<std::string> added;          ///< cells that only the candidate has
  std::vector<std::string> regressions;    ///< "cell: was ok, is invalid: why"
  std::vector<std::string> repairs;        ///< the other way round
  std::vector<std::string> still_failing;  ///< failed in both
  std::size_t other_impacts = 0;           ///< pairs that were not hit in the same way
};

/// "bunny/single/single-0003/cvd", with "#2" where there are repeats.
std::string cell_name(const CellSummary& cell);

CellPairs match_cells(const Results& baseline, const Results& candidate);

}  // namespace fracbench
