#pragma once

#include "reports/report_item.h"

namespace fracbench::synthetic {

/// A cell that broke into fragments of these volumes (of 10), with values for all metrics.
CellSummary broken_cell(std::string label, std::string shape, int collision,
                        std::vector<double> volumes);

/// A cell that has nothing but a status.
CellSummary failed_cell(std::string label, std::string shape, int collision, CellStatus status,
                        std::string reason);

/// Volumes drawn from Mott's law.
std::vector<double> mott_volumes(Random& random, double mean, int count);

/// Two methods on one shape over so many collisions; the second makes bigger fragments where
/// `differ`.
ReportInput two_methods(int collisions, bool differ);

/// The section of that item.
ReportSection section(const ReportInput& input, std::string_view item);

/// The table of that name; fails the test where it is not there.
Table table(const ReportSection& section, std::string_view name);

/// The cell of that row and column.
TableCell at(const Table& table, std::size_t row, std::string_view column);

}  // namespace fracbench::synthetic
