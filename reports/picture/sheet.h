#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/cell_summary.h"

namespace fracbench {

/// A row of a sheet of pictures: one impact on one shape, the cells by the label of their method.
struct SheetRow {
  std::string name;  ///< "<shape>-<scenario>"
  std::map<std::string, const CellSummary*> cells;
};

struct SheetOptions {
  std::vector<std::string> shapes = {};   ///< empty: all
  std::vector<std::string> methods = {};  ///< labels; empty: all
  int collisions = 1;                     ///< of each shape: those that most methods broke it in
};

/// What is worth a picture, first repeats only; cells that ended neither `ok` nor `unbroken` are
/// left out.
std::vector<SheetRow> sheet_rows(const std::vector<CellSummary>& cells,
                                 const SheetOptions& options = {});

/// The methods in those rows, in the order of `cells`.
std::vector<std::string> sheet_columns(const std::vector<CellSummary>& cells,
                                       const std::vector<SheetRow>& rows);

/// The file of a picture, without ending.
std::string picture_name(const SheetRow& row, const std::string& method);

}  // namespace fracbench
