#include "reports/latex/latex.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "reports/latex/write_latex.h"
#include "synthetic_cells.h"

namespace fracbench {
namespace {

using namespace synthetic;
namespace fs = std::filesystem;

TEST(Latex, EscapesWhatMeansSomething) {
  EXPECT_EQ(escape_latex("50 % of a_b & {c}"), "50 \\% of a\\_b \\& \\{c\\}");
  EXPECT_EQ(escape_latex("\\~^"), "\\textbackslash{}\\textasciitilde{}\\textasciicircum{}");
  EXPECT_EQ(escape_latex("m\xC2\xB2"), "m\\textsuperscript{2}");
  EXPECT_EQ(escape_latex("\xE2\x98\x83"), "?");
}

TEST(Latex, PutsNumbersToTheRightAndKeepsEveryRow) {
  const Table table{.name = "t",
                    .title = "T",
                    .columns = {{"name"}, {"size", "m"}},
                    .rows = {{std::string("[a]"), 1.5}, {std::string("b"), Estimate{2, 1, 3}}}};
  const std::string latex = to_latex(table);
  EXPECT_NE(latex.find("\\begin{tabular}{lr}"), std::string::npos);
  EXPECT_NE(latex.find("{[a]} & {1.5} \\\\"), std::string::npos);
  EXPECT_NE(latex.find("{b} & {2 [1, 3]} \\\\"), std::string::npos);
}

TEST(Latex, OfAFigureWithoutPointsIsNothing) { EXPECT_EQ(to_pgfplots(Figure()), ""); }

TEST(Latex, TheWholeReportCompiles) {
  if (std::system("pdflatex --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "no pdflatex; Debian: texlive-latex-recommended, texlive-pictures";
  }
  ReportInput input = two_methods(5, true);
  for (CellSummary& cell : input.cells) cell.shape = "50 % of {a_b} & $c^2$ \\";
  input.title = "A & B_1";
  const fs::path folder = fs::path(testing::TempDir()) / "fracbench-latex";
  fs::remove_all(folder);
  write_files(render_latex(input, render_sections(input)), folder);
  const std::string command = "cd '" + (folder / "latex").string() +
                              "' && pdflatex -interaction=nonstopmode -halt-on-error report.tex "
                              "> output.txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << "see " << folder / "latex/report.log";
  EXPECT_GT(fs::file_size(folder / "latex/report.pdf"), 10000u);
}

}  // namespace
}  // namespace fracbench
