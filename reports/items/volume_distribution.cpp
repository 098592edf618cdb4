#include "reports/items/volume_distribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "core/parallel.h"
#include "metrics/distribution_distance.h"
#include "metrics/fragment_volumes.h"
#include "metrics/mott.h"
#include "metrics/summary.h"
#include "reports/cell_groups.h"
#include "reports/shape_volumes.h"

namespace fracbench {
namespace {

constexpr const char* kVolumeUnit = "V_body / 10";

std::vector<TableCell> mott_row(const ShapeVolumes& shape, const CellGroup& group,
                                const ReportInput& input) {
  const std::vector<std::vector<CellRef>> collisions = by_collision(group.cells);
  const CollisionVolumes volumes(collisions, group.label, shape.cut);
  // The last four columns, of the law that is fitted to the sample: anew in each resample.
  const auto statistics = [&](std::span<const std::size_t> chosen) {
    std::vector<std::optional<double>> values(4);
    const std::vector<double> sample = volumes.of(chosen);
    const auto law = Mott::fit(sample, shape.cut);
    if (!law) return values;
    const MottAsPrinted printed{.mean_volume = law->mean_volume, .cut = law->cut};
    values[0] = law->mean_volume;
    values[1] = kolmogorov_smirnov(sample, [&](double v) { return law->distribution(v); });
    values[2] = wasserstein(sample, *law);
    values[3] = kolmogorov_smirnov(sample, [&](double v) { return printed.distribution(v); });
    return values;
  };
  std::vector<TableCell> row = {
      shape.shape,
      group.label,
      static_cast<std::int64_t>(collisions.size()),
      static_cast<std::int64_t>(volumes_above(group.cells, 0).size()),
      shape.cut,
      static_cast<std::int64_t>(volumes_above(group.cells, shape.cut).size()),
  };
  std::ranges::move(joint_estimates(collisions.size(), statistics, input,
                                    fmt::format("{} {} mott", shape.shape, group.label)),
                    std::back_inserter(row));
  return row;
}

Table mott_table(const std::vector<ShapeVolumes>& shapes, const ReportInput& input) {
  Table table{.name = "volume_distribution",
              .title = "Fragment volumes against Mott's law",
              .notes = {"The body's volume is 10. Only fragments above the cut are compared, and "
                        "the laws are conditional on it. The mean of Mott's law is fitted to the "
                        "fragments above the cut. KS: Kolmogorov-Smirnov distance; W: "
                        "Wasserstein-1 distance, which is infinite to the law as printed "
                        "(`docs/metrics.md`)."},
              .columns = {{"shape"},
                          {"method"},
                          {"collisions"},
                          {"fragments"},
                          {"cut", kVolumeUnit},
                          {"above cut"},
                          {"mean of Mott's law", kVolumeUnit},
                          {"KS to mott"},
                          {"W to mott", kVolumeUnit},
                          {"KS to mott-as-printed"}}};
  std::vector<std::pair<const ShapeVolumes*, const CellGroup*>> places;
  for (const ShapeVolumes& shape : shapes) {
    for (const CellGroup& group : shape.methods) places.emplace_back(&shape, &group);
  }
  table.rows.resize(places.size());
  parallel_for(places.size(), hardware_threads(), [&](std::size_t i) {
    table.rows[i] = mott_row(*places[i].first, *places[i].second, input);
  });
  return table;
}

// KS and W of two samples.
std::vector<std::optional<double>> distances(std::span<const double> x, std::span<const double> y) {
  if (x.empty() || y.empty()) return {std::nullopt, std::nullopt};
  return {kolmogorov_smirnov(x, y), wasserstein(x, y)};
}

// The distances of two methods, with their intervals from drawing collisions of both.
std::vector<TableCell> distances_between(const CellGroup& a, const CellGroup& b, double cut,
                                         const ReportInput& input) {
  std::vector<CellRef> both = a.cells;
  both.insert(both.end(), b.cells.begin(), b.cells.end());
  const std::vector<std::vector<CellRef>> collisions = by_collision(both);
  const CollisionVolumes of_a(collisions, a.label, cut);
  const CollisionVolumes of_b(collisions, b.label, cut);
  const auto statistics = [&](std::span<const std::size_t> chosen) {
    return distances(of_a.of(chosen), of_b.of(chosen));
  };
  return joint_estimates(collisions.size(), statistics, input,
                         fmt::format("{} {} {} distances", a.shape, a.label, b.label));
}

// The distances between every other collision of a method and the rest: what chance alone makes.
std::vector<TableCell> distances_of_halves(const CellGroup& group, double cut) {
  std::array<std::vector<CellRef>, 2> halves;
  const std::vector<std::vector<CellRef>> collisions = by_collision(group.cells);
  for (std::size_t i = 0; i < collisions.size(); ++i) {
    halves[i % 2].insert(halves[i % 2].end(), collisions[i].begin(), collisions[i].end());
  }
  std::vector<TableCell> cells;
  for (const std::optional<double>& distance :
       distances(volumes_above(halves[0], cut), volumes_above(halves[1], cut))) {
    cells.push_back(number_or_nothing(distance));
  }
  return cells;
}

Table method_table(const std::vector<ShapeVolumes>& shapes, const ReportInput& input) {
  Table table{
      .name = "volume_distances",
      .title = "Fragment volumes of two methods",
      .notes = {"Above the same cut, with intervals from drawing whole collisions and "
                "taking the fragments of both methods. The distance between two halves of "
                "the collisions of one method is what chance makes of no difference (with "
                "half the data, so rather more of it)."},
      .columns = {
          {"shape"}, {"method"}, {"other"}, {"cut", kVolumeUnit}, {"KS"}, {"W", kVolumeUnit}}};
  struct Place {
    const ShapeVolumes& shape;
    const CellGroup& method;
    const CellGroup* other;  // null: its other half
  };
  std::vector<Place> places;
  for (const ShapeVolumes& shape : shapes) {
    for (std::size_t i = 0; i < shape.methods.size(); ++i) {
      const CellGroup& method = shape.methods[i];
      if (by_collision(method.cells).size() > 1) places.push_back({shape, method, nullptr});
      for (std::size_t j = i + 1; j < shape.methods.size(); ++j) {
        places.push_back({shape, method, &shape.methods[j]});
      }
    }
  }
  table.rows.resize(places.size());
  parallel_for(places.size(), hardware_threads(), [&](std::size_t i) {
    const auto& [shape, method, other] = places[i];
    std::vector<TableCell>& row = table.rows[i];
    const std::string other_name = other ? std::string(other->label) : "(its other half)";
    row = {shape.shape, method.label, other_name, shape.cut};
    std::ranges::move(other ? distances_between(method, *other, shape.cut, input)
                            : distances_of_halves(method, shape.cut),
                      std::back_inserter(row));
  });
  return table;
}

// Share of fragments above each volume, for plots: of the sample and of both laws.
Table curve_table(const std::vector<ShapeVolumes>& shapes) {
  Table table{.name = "volume_curves",
              .title = "Share of fragments above a volume",
              .notes = {"One line for each of 200 volumes between the cut and the whole body, "
                        "evenly spaced in the logarithm."},
              .columns = {{"shape"},
                          {"method"},
                          {"volume", kVolumeUnit},
                          {"measured"},
                          {"mott"},
                          {"mott-as-printed"}},
              .in_text = false};
  constexpr int points = 200;
  for (const ShapeVolumes& shape : shapes) {
    for (const CellGroup& group : shape.methods) {
      const std::vector<double> volumes = sorted(volumes_above(group.cells, shape.cut));
      const auto law = Mott::fit(volumes, shape.cut);
      if (!law) continue;
      const MottAsPrinted printed{.mean_volume = law->mean_volume, .cut = law->cut};
      const double low = shape.cut > 0 ? shape.cut : volumes.front();
      for (int k = 0; k < points; ++k) {
        const double volume = low * std::pow(kParentVolume / low, k / (points - 1.0));
        const auto above = volumes.end() - std::ranges::upper_bound(volumes, volume);
        table.rows.push_back({shape.shape, group.label, volume,
                              static_cast<double>(above) / static_cast<double>(volumes.size()),
                              law->survival(volume), 1 - printed.distribution(volume)});
      }
    }
  }
  return table;
}

/// A figure for each shape of the table of curves.
std::vector<Figure> curve_figures(const Table& curves, const ReportInput& input) {
  std::vector<Figure> figures;
  std::string shape;
  std::string method;
  for (const auto& row : curves.rows) {
    const auto& row_shape = std::get<std::string>(row[0]);
    const auto& row_method = std::get<std::string>(row[1]);
    if (figures.empty() || row_shape != shape) {
      shape = row_shape;
      method.clear();
      figures.push_back({.name = "volume_curves_" + file_name_part(shape),
                         .title = "Fragment volumes: " + shape,
                         .notes = {"Share of the fragments above a volume; dashed: Mott's law with "
                                   "the same mean above the cut."},
                         .x = {.label = "volume [V_body = 10]", .logarithmic = true},
                         .y = {.label = "share above", .logarithmic = true}});
    }
    std::vector<FigureSeries>& series = figures.back().series;
    if (row_method != method) {
      method = row_method;
      const std::size_t colour = method_place(input, method);
      series.push_back({.name = {}, .colour = colour, .dashed = true, .faint = true});
      series.push_back({.name = method, .colour = colour});
    }
    const double volume = std::get<double>(row[2]);
    FigureSeries& law = series[series.size() - 2];
    // Below a thousandth the law is beyond what any sample shows.
    if (const double share = std::get<double>(row[4]); share > 1e-3) {
      law.x.push_back(volume);
      law.y.push_back(share);
    }
    series.back().x.push_back(volume);
    series.back().y.push_back(std::get<double>(row[3]));
  }
  return figures;
}

}  // namespace

ReportItemInfo VolumeDistribution::info() const {
  return {.name = "volume_distribution", .title = "Fragment volumes"};
}

ReportSection VolumeDistribution::render(const ReportInput& input) const {
  const std::vector<ShapeVolumes> shapes = volumes_by_shape(input);
  ReportSection section;
  const Table curves = curve_table(shapes);
  section.figures = curve_figures(curves, input);
  for (Table& table :
       std::vector<Table>{mott_table(shapes, input), method_table(shapes, input), curves}) {
    if (!table.rows.empty()) section.tables.push_back(std::move(table));
  }
  return section;
}

}  // namespace fracbench
