#include "reports/figure_of_table.h"

#include <algorithm>

#include "reports/cell_groups.h"

namespace fracbench {

namespace {

std::optional<Estimate> number_in(const TableCell& cell) {
  if (const auto* estimate = std::get_if<Estimate>(&cell)) return *estimate;
  if (const auto* real = std::get_if<double>(&cell)) return Estimate{*real, *real, *real};
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) {
    const auto value = static_cast<double>(*integer);
    return Estimate{value, value, value};
  }
  return std::nullopt;
}

std::size_t place_in(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  names.push_back(name);
  return names.size() - 1;
}

}  // namespace

std::optional<Figure> figure_of_column(const Table& table, std::size_t column,
                                       const ReportInput& input, Figure figure) {
  std::vector<std::string> methods;
  for (const auto& row : table.rows) {
    const auto number = number_in(row.at(column));
    if (!number) continue;
    const std::size_t shape = place_in(figure.x.categories, std::get<std::string>(row[0]));
    const std::size_t method = place_in(methods, std::get<std::string>(row[1]));
    if (method == figure.series.size()) {
      figure.series.push_back({.name = methods.back(),
                               .colour = method_place(input, methods.back()),
                               .mark = Mark::intervals});
    }
    FigureSeries& series = figure.series[method];
    series.x.push_back(static_cast<double>(shape));
    series.y.push_back(number->value);
    series.low.push_back(number->low);
    series.high.push_back(number->high);
  }
  if (methods.empty()) return std::nullopt;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const double count = static_cast<double>(methods.size());
    const double aside = (static_cast<double>(m) - (count - 1) / 2) * 0.7 / count;
    for (double& x : figure.series[m].x) x += aside;
  }
  return figure;
}

}  // namespace fracbench
