#include "reports/write_report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "core/error.h"
#include "reports/csv.h"
#include "synthetic_cells.h"

namespace fracbench {
namespace {

using namespace synthetic;
namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("fracbench-report-" + name);
  fs::remove_all(folder);
  return folder;
}

std::vector<ReportFile> render_whole_report(const ReportInput& input) {
  return render_report(input, render_sections(input));
}

fs::path write_whole_report(const ReportInput& input, const fs::path& folder) {
  return write_report(input, render_sections(input), folder);
}

TEST(WriteReport, writes_the_text_and_every_table_that_it_names) {
  const fs::path folder = fresh_folder("all");
  const fs::path report = write_whole_report(two_methods(5, true), folder / "deep" / "er");
  EXPECT_EQ(report, folder / "deep" / "er" / "report.md");
  const std::string text = bytes_of(report);
  EXPECT_TRUE(text.starts_with("# Two methods\n"));
  std::set<std::string> linked;
  const std::regex link(R"(\]\(([^)]+\.csv)\))");
  for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i) {
    linked.insert((*i)[1]);
  }
  EXPECT_TRUE(linked.contains("cells.csv"));
  EXPECT_TRUE(linked.contains("volumes.csv"));
  EXPECT_TRUE(linked.contains("volume_curves.csv"));
  std::set<std::string> present;
  for (const auto& entry : fs::directory_iterator(report.parent_path())) {
    if (entry.path().extension() == ".csv") present.insert(entry.path().filename());
    const std::string name = entry.path().filename();
    if (name.ends_with(".svg")) {
      EXPECT_NE(text.find(fmt::format("]({})", name)), std::string::npos) << name;
    } else {
      EXPECT_TRUE(name.ends_with(".csv") || entry.path() == report) << name;
    }
  }
  EXPECT_EQ(linked, present);
  for (const std::string& name : present) {
    const auto lines = parse_csv(bytes_of(report.parent_path() / name), name);
    ASSERT_GT(lines.size(), 1u) << name;
    for (const auto& line : lines) EXPECT_EQ(line.size(), lines[0].size()) << name;
  }
  fs::remove_all(folder);
}

TEST(WriteReport, raw_data_hold_every_value_and_every_fragment) {
  ReportInput input = two_methods(3, true);
  input.cells.push_back(failed_cell("fine", "squirrel", 9, CellStatus::timeout, "10 s, \"hard\""));
  for (const ReportFile& file : render_whole_report(input)) {
    if (file.name == "volumes.csv") {
      EXPECT_EQ(parse_csv(file.bytes, "").size(), 1 + 6 * 17u);
    }
    if (file.name != "cells.csv") continue;
    const auto lines = parse_csv(file.bytes, "");
    ASSERT_EQ(lines.size(), 8u);
    const auto column = std::ranges::find(lines[0], "fragment_count") - lines[0].begin();
    EXPECT_EQ(lines[1].at(column), "17");
    EXPECT_EQ(lines[7].at(column), "");
    EXPECT_NE(std::ranges::find(lines[7], "10 s, \"hard\""), lines[7].end());
    EXPECT_NE(std::ranges::find(lines[1], "18446744073709551615"), lines[1].end());  // the seed
  }
}

TEST(WriteReport, same_input_and_seed_give_the_same_bytes) {
  ReportInput input = two_methods(6, true);
  const auto first = render_whole_report(input);
  const auto second = render_whole_report(input);
  input.seed += 1;
  const auto reseeded = render_whole_report(input);
  ASSERT_EQ(first.size(), second.size());
  bool differs = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].bytes, second[i].bytes) << first[i].name;
    differs = differs || first[i].bytes != reseeded[i].bytes;
  }
  EXPECT_TRUE(differs);
}

TEST(WriteReport, has_no_numbers_that_are_none) {
  for (const ReportFile& file : render_whole_report(two_methods(2, true))) {
    EXPECT_FALSE(std::regex_search(file.bytes, std::regex(R"((^|[ ,|\[])-?(nan|inf)([ ,|\]]|$))")))
        << file.name;
  }
}

TEST(WriteReport, of_nothing_is_a_report_that_says_so) {
  const auto files = render_whole_report({});
  ASSERT_EQ(files.back().name, "report.md");
  EXPECT_NE(files.back().bytes.find("no cells"), std::string::npos);
}

TEST(WriteReport, into_a_place_that_is_a_file_is_refused_with_its_name) {
  const fs::path folder = fresh_folder("file");
  std::ofstream(folder) << "x";
  try {
    write_whole_report(two_methods(2, true), folder);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(folder.string()), std::string::npos);
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace fracbench
