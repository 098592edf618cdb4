#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "harness/cell_summary.h"
#include "reports/report_item.h"

namespace fracbench {

using CellRef = std::reference_wrapper<const CellSummary>;

/// The cells of one method and shape.
struct CellGroup {
  std::string label;  ///< of the method
  std::string shape;
  std::vector<CellRef> cells;
};

/// All cells by shape and method, both in the order in which they first appear.
std::vector<CellGroup> group_cells(const std::vector<CellSummary>& cells);

/// The place of a method among those of the report: its colour in all figures.
std::size_t method_place(const ReportInput& input, std::string_view label);

/// The resolution of the grid that a cell's method cuts on: its option, or the finest of its
/// outputs; 0 for methods without.
int cut_resolution(const CellSummary& cell);

/// The cells that ended `ok`: what is pooled.
std::vector<CellRef> broken_cells(std::span<const CellRef> cells);

/// The value of that metric, where the cell has it.
std::optional<double> value_of(const CellSummary& cell, std::string_view metric);
std::string unit_of(const CellSummary& cell, std::string_view metric);

/// The series of that name; empty where the cell has none.
std::span<const double> series_of(const CellSummary& cell, std::string_view name);

/// The values of that metric in the cells that have it.
std::vector<double> values_of(std::span<const CellRef> cells, std::string_view metric);

/// Cells by collision: those that met the same impact, whatever the method and repeat, in the order
/// in which they first appear. These are the clusters of the bootstrap.
std::vector<std::vector<CellRef>> by_collision(std::span<const CellRef> cells);

/// Numbers of cells, collision by collision, ready to be drawn again and again.
class CollisionValues {
 public:
  /// `value` tells that of a cell, where it has one.
  CollisionValues(std::span<const std::vector<CellRef>> collisions,
                  const std::function<std::optional<double>(const CellSummary&)>& value);

  /// The values of these collisions together; of one that is named twice, twice.
  std::vector<double> of(std::span<const std::size_t> chosen) const;

 private:
  std::vector<std::vector<double>> values_;
};

/// The statistic of all cells with its interval from resampling whole collisions; only the value
/// where there is no interval, nothing where there is no value. `name` sets the random numbers
/// apart from those of other statistics.
TableCell estimate(std::span<const CellRef> cells,
                   const std::function<std::optional<double>(std::span<const CellRef>)>& statistic,
                   const ReportInput& input, std::string_view name);

/// The same for a statistic of collisions, by their numbers.
TableCell estimate(std::size_t collisions, const ClusterStatistic& statistic,
                   const ReportInput& input, std::string_view name);

/// The same for statistics that have work in common, in their order.
std::vector<TableCell> joint_estimates(std::size_t collisions, const ClusterStatistics& statistics,
                                       const ReportInput& input, std::string_view name);

/// The same for the mean of a metric.
TableCell estimated_mean(std::span<const CellRef> cells, std::string_view metric,
                         const ReportInput& input);

}  // namespace fracbench
