#include "reports/page/html_page.h"

#include <gtest/gtest.h>

#include <regex>

#include "synthetic_cells.h"

namespace fracbench {
namespace {

using namespace synthetic;

std::string page(const ReportInput& input, const PageOptions& options = {}) {
  return html_page(input, render_sections(input), options);
}

/// How often elements are opened less how often they are closed.
int unclosed(const std::string& html, const std::string& name) {
  const auto count = [&](const std::string& pattern) {
    const std::regex expression(pattern);
    return std::distance(std::sregex_iterator(html.begin(), html.end(), expression), {});
  };
  return static_cast<int>(count("<" + name + "[ >]") - count("</" + name + ">"));
}

TEST(HtmlPage, HasEverySectionAndALineForEachCell) {
  const ReportInput input = two_methods(4, true);
  const std::string html = page(input);
  for (const NamedSection& named : render_sections(input)) {
    EXPECT_NE(html.find("<section id=\"" + named.item.name + "\">"), std::string::npos);
    EXPECT_NE(html.find("<a href=\"#" + named.item.name + "\">"), std::string::npos);
  }
  for (const CellSummary& cell : input.cells) {
    EXPECT_NE(html.find("<code>" + cell.key.substr(0, 12) + "</code>"), std::string::npos);
  }
  for (const char* name : {"table", "tr", "td", "section", "figure", "svg", "div", "p", "ul"}) {
    EXPECT_EQ(unclosed(html, name), 0) << name;
  }
}

TEST(HtmlPage, SaysWhereNotAllCellsAreShown) {
  const ReportInput input = two_methods(4, true);
  EXPECT_EQ(page(input, {.cells = 8}).find("of 8 cells"), std::string::npos);
  EXPECT_NE(page(input, {.cells = 800}).find("8 of 800 cells"), std::string::npos);
}

TEST(HtmlPage, LoadsNothingFromElsewhere) {
  const std::string html = page(two_methods(3, true));
  EXPECT_EQ(html.find("http://"), html.find("http://www.w3.org/2000/svg"));
  EXPECT_EQ(html.find("https://"), std::string::npos);
}

TEST(HtmlPage, NamesFromRecordsCannotBecomeMarkup) {
  ReportInput input = two_methods(3, true);
  for (CellSummary& cell : input.cells) {
    cell.key = std::string(64, 'a');
    cell.shape = "</script><script>alert(1)</script>";
    cell.reason = "\"><img src=x>";
  }
  const std::string html = page(input, {.viewed = {std::string(64, 'a')}});
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_EQ(html.find("<img"), std::string::npos);
}

TEST(HtmlPage, SaysWhereThereIsNoViewer) {
  EXPECT_NE(page(two_methods(3, true), {.script = false}).find("without its viewer"),
            std::string::npos);
}

}  // namespace
}  // namespace fracbench
