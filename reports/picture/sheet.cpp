#include "reports/picture/sheet.h"

#include <algorithm>

#include "reports/figure.h"

namespace fracbench {

namespace {

bool wanted(const std::vector<std::string>& list, const std::string& name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

}  // namespace

std::vector<SheetRow> sheet_rows(const std::vector<CellSummary>& cells,
                                 const SheetOptions& options) {
  std::map<std::string, std::vector<SheetRow>> by_shape;
  std::vector<std::string> shapes;
  for (const CellSummary& cell : cells) {
    const bool seen = cell.status == CellStatus::ok || cell.status == CellStatus::unbroken;
    if (!seen || cell.repeat > 0 || !wanted(options.shapes, cell.shape) ||
        !wanted(options.methods, cell.label)) {
      continue;
    }
    if (!by_shape.contains(cell.shape)) shapes.push_back(cell.shape);
    std::vector<SheetRow>& list = by_shape[cell.shape];
    const std::string name = cell.shape + "-" + cell.scenario;
    if (list.empty() || list.back().name != name) list.push_back({name, {}});
    list.back().cells[cell.label] = &cell;
  }
  const auto broken = [](const SheetRow& row) {
    return std::ranges::count_if(
        row.cells, [](const auto& cell) { return cell.second->status == CellStatus::ok; });
  };
  std::vector<SheetRow> rows;
  for (const std::string& shape : shapes) {
    std::vector<SheetRow>& list = by_shape[shape];
    std::ranges::stable_sort(
        list, [&](const SheetRow& a, const SheetRow& b) { return broken(a) > broken(b); });
    const auto count = std::min(list.size(), static_cast<std::size_t>(options.collisions));
    rows.insert(rows.end(), list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return rows;
}

std::vector<std::string> sheet_columns(const std::vector<CellSummary>& cells,
                                       const std::vector<SheetRow>& rows) {
  std::vector<std::string> columns;
  for (const CellSummary& cell : cells) {
    const bool there = std::ranges::any_of(
        rows, [&](const SheetRow& row) { return row.cells.contains(cell.label); });
    if (there && std::ranges::find(columns, cell.label) == columns.end()) {
      columns.push_back(cell.label);
    }
  }
  return columns;
}

std::string picture_name(const SheetRow& row, const std::string& method) {
  return file_name_part(row.name + "-" + method);
}

}  // namespace fracbench
