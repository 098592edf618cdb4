#pragma once

#include <cstddef>
#include <optional>

#include "reports/figure.h"
#include "reports/report_item.h"
#include "reports/table.h"

namespace fracbench {

/// A figure of one column of a table whose first two columns are shape and method: shapes along x,
/// the methods side by side at each, estimates with their intervals. `figure` brings name, title
/// and the label of y; nothing where no row has a number.
std::optional<Figure> figure_of_column(const Table& table, std::size_t column,
                                       const ReportInput& input, Figure figure);

}  // namespace fracbench
