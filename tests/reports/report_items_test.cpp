#include "reports/report_items.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "synthetic_cells.h"

namespace fracbench {
namespace {

using namespace synthetic;

double number(const TableCell& cell) {
  if (const auto* e = std::get_if<Estimate>(&cell)) return e->value;
  if (const auto* i = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*i);
  return std::get<double>(cell);
}

TEST(ReportItems, have_unique_names_titles_and_table_names) {
  std::set<std::string> names;
  std::set<std::string> tables{"cells", "volumes"};
  for (const auto& item : report_items()) {
    EXPECT_TRUE(names.insert(item->info().name).second);
    EXPECT_FALSE(item->info().title.empty());
    for (const Table& table : item->render(two_methods(4, true)).tables) {
      EXPECT_TRUE(tables.insert(table.name).second) << table.name;
      for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
    }
  }
}

TEST(ReportItems, take_nothing_single_cells_and_failed_cells) {
  ReportInput one{.title = "", .cells = {broken_cell("cvd", "pot", 0, {4, 6})}};
  ReportInput failed{.title = "",
                     .cells = {failed_cell("cvd", "pot", 0, CellStatus::crash, "signal 11")}};
  ReportInput whole{.title = "", .cells = {broken_cell("cvd", "pot", 0, {10})}};
  whole.cells[0].status = CellStatus::unbroken;
  for (const ReportInput& input : {ReportInput{}, one, failed, whole}) {
    for (const auto& item : report_items()) EXPECT_NO_THROW(item->render(input));
  }
}

TEST(Overview, counts_each_status_and_says_why) {
  ReportInput input = two_methods(3, false);
  input.cells.push_back(failed_cell("fine", "squirrel", 8, CellStatus::invalid, "not closed"));
  input.cells.push_back(failed_cell("fine", "squirrel", 9, CellStatus::invalid, "not closed"));
  input.cells.push_back(failed_cell("fine", "pot", 9, CellStatus::unbroken, ""));
  const ReportSection overview = section(input, "overview");
  const Table cells = table(overview, "overview");
  ASSERT_EQ(cells.rows.size(), 3u);
  EXPECT_EQ(at(cells, 0, "method"), TableCell(std::string("fine")));
  EXPECT_EQ(number(at(cells, 0, "cells")), 5);
  EXPECT_EQ(number(at(cells, 0, "ok")), 3);
  EXPECT_EQ(number(at(cells, 0, "invalid")), 2);
  EXPECT_EQ(number(at(cells, 2, "unbroken")), 1);
  const Table reasons = table(overview, "reasons");
  ASSERT_EQ(reasons.rows.size(), 1u);
  EXPECT_EQ(number(at(reasons, 0, "cells")), 2);
  EXPECT_EQ(at(reasons, 0, "reason"), TableCell(std::string("not closed")));
}

TEST(FragmentCountsItem, pools_collisions_that_broke_the_body) {
  ReportInput input{.title = ""};
  for (int i = 0; i < 10; ++i) {
    input.cells.push_back(broken_cell("cvd", "pot", i, std::vector<double>(10 + i % 3, 0.5)));
  }
  input.cells.push_back(broken_cell("cvd", "pot", 11, {10}));
  input.cells.back().status = CellStatus::unbroken;
  const Table counts = table(section(input, "fragment_counts"), "fragment_counts");
  ASSERT_EQ(counts.rows.size(), 1u);
  EXPECT_EQ(number(at(counts, 0, "collisions")), 10);
  EXPECT_NEAR(number(at(counts, 0, "mean")), 10.9, 1e-12);
  EXPECT_EQ(number(at(counts, 0, "most")), 12);
  const auto mean = std::get<Estimate>(at(counts, 0, "mean"));
  EXPECT_LT(mean.low, 10.9);
  EXPECT_GT(mean.high, 10.9);
}

TEST(FragmentCountsItem, repeats_of_one_collision_are_one_cluster) {
  // Ten repeats of two collisions say no more about other collisions than one of each.
  ReportInput input{.title = ""};
  for (int repeat = 0; repeat < 10; ++repeat) {
    input.cells.push_back(broken_cell("cvd", "pot", 0, std::vector<double>(5, 2)));
    input.cells.push_back(broken_cell("cvd", "pot", 1, std::vector<double>(15, 0.5)));
  }
  const Table counts = table(section(input, "fragment_counts"), "fragment_counts");
  EXPECT_EQ(number(at(counts, 0, "collisions")), 2);
  const auto mean = std::get<Estimate>(at(counts, 0, "mean"));
  EXPECT_EQ(mean.low, 5);
  EXPECT_EQ(mean.high, 15);
}

TEST(VolumeDistribution, finds_the_law_and_tells_two_methods_apart) {
  const ReportSection same = section(two_methods(40, false), "volume_distribution");
  const ReportSection other = section(two_methods(40, true), "volume_distribution");
  const Table mott = table(other, "volume_distribution");
  ASSERT_EQ(mott.rows.size(), 2u);
  EXPECT_NEAR(number(at(mott, 0, "cut")), 0.01, 1e-15);
  EXPECT_NEAR(number(at(mott, 0, "mean of Mott's law")), 0.6, 0.1);
  EXPECT_NEAR(number(at(mott, 1, "mean of Mott's law")), 2.4, 0.5);
  EXPECT_LT(number(at(mott, 0, "KS to mott")), 0.06);
  EXPECT_GT(number(at(mott, 0, "KS to mott-as-printed")), 0.8);
  const Table distances = table(other, "volume_distances");
  ASSERT_EQ(distances.rows.size(), 3u);
  const auto w_same = std::get<Estimate>(at(table(same, "volume_distances"), 1, "W"));
  const auto w_other = std::get<Estimate>(at(distances, 1, "W"));
  // The conditional means above the cut differ by about 4 * 0.6 - 0.6.
  EXPECT_NEAR(w_other.value, 2, 0.6);
  EXPECT_LT(w_same.value, 0.25);
  EXPECT_LT(w_same.high, w_other.low);
  // Chance alone makes a small distance.
  EXPECT_EQ(at(distances, 0, "other"), TableCell(std::string("(its other half)")));
  EXPECT_GT(number(at(distances, 0, "W")), 0);
  EXPECT_LT(number(at(distances, 0, "W")), 0.4);
  EXPECT_LT(number(at(distances, 0, "KS")), 0.15);
}

TEST(VolumeDistribution, cut_is_the_coarsest_of_the_methods_and_changes_what_is_compared) {
  ReportInput input = two_methods(10, false);
  for (CellSummary& cell : input.cells) {
    if (cell.label == "coarse") cell.values[2].value = 0.05;
  }
  const Table mott = table(section(input, "volume_distribution"), "volume_distribution");
  for (const std::size_t row : {0u, 1u}) {
    EXPECT_DOUBLE_EQ(number(at(mott, row, "cut")), 0.5);
    EXPECT_LT(number(at(mott, row, "above cut")), 0.5 * number(at(mott, row, "fragments")));
  }
}

TEST(VolumeDistribution, curves_fall_from_one_to_nothing) {
  const Table curves =
      table(section(two_methods(10, false), "volume_distribution"), "volume_curves");
  EXPECT_FALSE(curves.in_text);
  ASSERT_EQ(curves.rows.size(), 400u);
  EXPECT_EQ(number(at(curves, 0, "measured")), 1);
  EXPECT_NEAR(number(at(curves, 0, "mott")), 1, 1e-12);
  EXPECT_NEAR(number(at(curves, 199, "volume")), 10, 1e-12);
  for (std::size_t row = 1; row < 200; ++row) {
    for (const char* column : {"measured", "mott", "mott-as-printed"}) {
      EXPECT_LE(number(at(curves, row, column)), number(at(curves, row - 1, column)));
    }
  }
}

TEST(ValidityItem, shows_the_worst_case_of_cells_that_are_invalid_too) {
  ReportInput input = two_methods(3, false);
  CellSummary bad = broken_cell("fine", "squirrel", 7, {5, 4});
  bad.status = CellStatus::invalid;
  for (MetricValue& value : bad.values) {
    if (value.name == "volume_ratio") value.value = 0.9;
    if (value.name == "valid" || value.name == "closed") value.value = 0;
  }
  input.cells.push_back(bad);
  const Table validity = table(section(input, "validity"), "validity");
  EXPECT_EQ(number(at(validity, 0, "cells")), 4);
  EXPECT_EQ(number(at(validity, 0, "valid")), 3);
  EXPECT_EQ(number(at(validity, 0, "disjoint")), 4);
  EXPECT_NEAR(number(at(validity, 0, "worst volume error")), 0.1, 1e-15);
  EXPECT_EQ(number(at(validity, 1, "worst volume error")), 0);
}

TEST(LabelAgreementItem, PoolsByShapeAndMethodAndTellsTheFloorApart) {
  ReportInput input;
  EXPECT_TRUE(section(input, "label_agreement").tables.empty());
  for (const double index : {0.2, 0.4}) {
    input.agreements.push_back({.shape = "pot",
                                .label = "cvd",
                                .family = "single",
                                .scenario = "single-0000",
                                .agreement = {.partition = {.adjusted_rand = index}}});
  }
  input.agreements.push_back({.shape = "pot",
                              .label = "bem",
                              .family = "single",
                              .scenario = "single-0000",
                              .other_impact = true,
                              .agreement = {.partition = {.adjusted_rand = 0.1}}});
  const Table shown = table(section(input, "label_agreement"), "label_agreement");
  ASSERT_EQ(shown.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(number(at(shown, 0, "mean")), 0.3);
  EXPECT_DOUBLE_EQ(number(at(shown, 0, "standard error")), 0.1);
  EXPECT_EQ(std::get<std::string>(at(shown, 1, "method")), "bem, another impact");
  EXPECT_EQ(number(at(shown, 1, "standard error")), 0);
}

TEST(StageTimesItem, adds_up_and_stands_beside_what_was_published) {
  ReportInput input = two_methods(3, false);
  for (CellSummary& cell : input.cells) {
    if (cell.label == "coarse") cell.label = "bem";
    cell.stages.push_back({"simulation", 0.01});
  }
  input.cells[0].total_seconds = 2;
  const ReportSection times = section(input, "stage_times");
  const Table stages = table(times, "stage_times");
  EXPECT_EQ(stages.rows.size(), 8u);
  EXPECT_NEAR(number(at(stages, 1, "mean")), 0.75, 1e-15);
  const Table machine = table(times, "machine");
  EXPECT_EQ(number(at(machine, 0, "cells that do not add up")), 1);
  EXPECT_EQ(number(at(machine, 1, "cells that do not add up")), 0);
}

TEST(PaperTablesItem, stands_beside_what_was_published) {
  ReportInput input = two_methods(3, false);
  for (CellSummary& cell : input.cells) {
    if (cell.label == "coarse") {
      cell.label = cell.method = "bem";
      cell.stages.push_back({"simulation", 8});
    } else {
      cell.label = cell.method = "deepfracture";
      cell.method_options = R"({"resolution": 0, "resolutions": [64, 128]})";
      cell.stages = {{"prediction", 0.01}, {"segmentation", 0.025}, {"boolean", 0.04}};
    }
  }
  const ReportSection paper = section(input, "paper_tables");
  const Table published = table(paper, "published_times");
  EXPECT_EQ(published.rows.size(), 17u);  // of squirrel
  EXPECT_EQ(at(published, 0, "printed"), TableCell(std::string("15.5 min")));
  EXPECT_NEAR(number(at(published, 0, "measured")), 8, 1e-15);
  EXPECT_EQ(at(published, 0, "verdict"), TableCell(std::string("not-comparable")));
  for (std::size_t row = 0; row < published.rows.size(); ++row) {
    if (at(published, row, "r") != TableCell(std::int64_t{256})) continue;
    EXPECT_EQ(at(published, row, "measured"), TableCell()) << "r = 256 was not run";
  }
  // 8 / 0.075 = 106.67, published 106.65: the same to two digits.
  const Table ratios = table(paper, "published_ratios");
  EXPECT_EQ(at(ratios, 0, "verdict"), TableCell(std::string("match")));
  // 0.025 / 0.04 against 2.49 / 6.01.
  EXPECT_EQ(at(ratios, 1, "verdict"), TableCell(std::string("mismatch")));
  EXPECT_EQ(at(ratios, 3, "verdict"), TableCell(std::string("not-comparable")));
  const Table kinds = table(paper, "table_1");
  EXPECT_EQ(at(kinds, 1, "property"), TableCell(std::string("retains the surface")));
  EXPECT_EQ(at(kinds, 1, "verdict"), TableCell(std::string("mismatch")));
}

TEST(ImpulseItem, tells_whether_stronger_impulses_make_more_and_smaller_fragments) {
  ReportInput input;
  for (int n = 0; n < 8; ++n) {
    std::vector<double> volumes(static_cast<std::size_t>(2 + n), 10.0 / (2 + n));
    input.cells.push_back(broken_cell("bem", "pot", n, volumes));
    input.cells.back().impulses = {100.0 * (n + 1), 10};
  }
  const ReportSection shown = section(input, "impulse_response");
  const Table response = table(shown, "impulse_response");
  EXPECT_NEAR(number(at(response, 0, "number of fragments")), 1, 1e-12);
  EXPECT_NEAR(number(at(response, 0, "volume of the largest")), -1, 1e-12);
  const Table impulses = table(shown, "impulses");
  EXPECT_EQ(number(at(impulses, 0, "largest")), 450);
  EXPECT_EQ(number(at(impulses, 0, "second largest")), 10);
  ASSERT_EQ(shown.figures.size(), 2u);
  EXPECT_EQ(shown.figures[0].series[0].x.size(), 8u);
  const Figure& strengths = shown.figures[1];  // by the largest impulse
  EXPECT_EQ(strengths.series.at(0).y.front(), 100);
  EXPECT_EQ(strengths.series.at(0).y.back(), 800);
  EXPECT_EQ(strengths.series.at(1).y, std::vector<double>(8, 10.0));
}

TEST(ResolutionItem, is_there_where_two_resolutions_are) {
  ReportInput input = two_methods(2, false);
  EXPECT_TRUE(section(input, "resolution_times").tables.empty());
  for (CellSummary& cell : input.cells) {
    const bool coarse = cell.label == "coarse";
    cell.method_options = coarse ? R"({"resolutions": [64]})" : R"({"resolution": 128})";
    cell.stages = {{"segmentation", coarse ? 0.01 : 0.08}};
  }
  const Table times = table(section(input, "resolution_times"), "resolution_times");
  ASSERT_EQ(times.rows.size(), 2u);
  EXPECT_EQ(at(times, 0, "r"), TableCell(std::int64_t{64}));
  EXPECT_NEAR(number(at(times, 0, "mean")), 0.01, 1e-15);
  EXPECT_NEAR(number(at(times, 1, "mean")), 0.08, 1e-15);
}

TEST(ClaimsItem, judges_what_is_nearer_to_the_reference) {
  // The subject has the fragments of the reference, the other one those of another law.
  ReportInput input = two_methods(8, true);
  std::vector<CellSummary> cells;
  for (const CellSummary& cell : input.cells) {
    const bool coarse = cell.label == "coarse";
    for (const char* label : {"bem", "deepfracture", "modes"}) {
      if ((std::string_view(label) == "modes") != coarse) continue;
      cells.push_back(cell);
      cells.back().label = cells.back().method = label;
    }
  }
  input.cells = cells;
  for (const CellSummary& cell : cells) {
    if (cell.label == "bem") continue;
    input.agreements.push_back(
        {.shape = cell.shape,
         .label = cell.label,
         .family = cell.family,
         .scenario = cell.scenario,
         .agreement = {.partition = {.adjusted_rand = cell.label == "modes" ? 0.9 : 0.1}}});
  }
  const Table claims = table(section(input, "claims"), "claims");
  std::map<std::string, std::string> verdicts;
  for (std::size_t row = 0; row < claims.rows.size(); ++row) {
    if (at(claims, row, "beside") != TableCell(std::string("modes"))) continue;
    verdicts[std::get<std::string>(at(claims, row, "claim"))] =
        std::get<std::string>(at(claims, row, "verdict"));
  }
  EXPECT_EQ(verdicts["volumes-nearest"], "holds");
  EXPECT_EQ(verdicts["count-nearest"], "holds");
  EXPECT_EQ(verdicts["agrees-with-bem"], "fails");
}

TEST(TrainingItem, tells_how_much_of_the_ceiling_was_reached) {
  ReportInput input = two_methods(2, false);
  EXPECT_TRUE(section(input, "training").tables.empty());
  CellSummary& cell = input.cells[1];
  cell.series.push_back({"" + cell.method + "_training_loss", {0.5, 0.1, 0.02}, ""});
  cell.series.push_back({"" + cell.method + "_round_trip", {1, 0.8}, ""});
  cell.series.push_back({"" + cell.method + "_decoded", {0.95, 0.4}, ""});
  cell.series.push_back({"" + cell.method + "_other_rows", {0.25}, ""});
  const ReportSection shown = section(input, "training");
  const Table learned = table(shown, "training");
  ASSERT_EQ(learned.rows.size(), 1u);
  EXPECT_EQ(number(at(learned, 0, "last loss")), 0.02);
  EXPECT_NEAR(number(at(learned, 0, "decoded, of the ceiling")), 75, 1e-12);
  EXPECT_EQ(number(at(learned, 0, "at 0.9 of their own ceiling")), 1);
  EXPECT_EQ(number(at(learned, 0, "codes that choose otherwise")), 25);
  ASSERT_EQ(shown.figures.size(), 1u);
  EXPECT_EQ(shown.figures[0].series[0].y, (std::vector<double>{0.5, 0.1, 0.02}));
}

TEST(TrainingItem, ShowsTheQualityAgainstTheNumberOfShapesInTheModel) {
  ReportInput input;
  for (const double shapes : {1.0, 4.0}) {
    CellSummary cell = broken_cell(shapes == 1 ? "alone" : "of four", "pot", 0, {5, 5});
    cell.series.push_back({cell.method + "_training_loss", {0.5}, ""});
    cell.series.push_back({cell.method + "_shapes", {shapes}, ""});
    cell.series.push_back({cell.method + "_round_trip", {0.8, 0.8}, ""});
    cell.series.push_back({cell.method + "_decoded", {0.8, 0.8 / shapes}, ""});
    input.cells.push_back(std::move(cell));
  }
  const ReportSection shown = section(input, "training");
  EXPECT_EQ(number(at(table(shown, "training"), 1, "shapes in the model")), 4);
  const auto figure = std::ranges::find(shown.figures, "quality_by_shapes", &Figure::name);
  ASSERT_NE(figure, shown.figures.end());
  ASSERT_EQ(figure->series.size(), 1u);
  EXPECT_EQ(figure->series[0].x, (std::vector<double>{1, 4}));
  EXPECT_NEAR(figure->series[0].y[0], 100, 1e-9);
  EXPECT_NEAR(figure->series[0].y[1], 62.5, 1e-9);
}

}  // namespace
}  // namespace fracbench
