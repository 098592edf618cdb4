#pragma once

#include <string>
#include <vector>

#include "reports/sections.h"
#include "reports/write_report.h"

namespace fracbench {

/// For papers: latex/<table>.tex (booktabs) and latex/<figure>.tex (pgfplots), methods.tex, a
/// paragraph with the exact settings of the suite, references.bib with every method that was used,
/// and report.tex, which holds them all and compiles with pdflatex. Tables of more than forty rows
/// are CSV only.
std::vector<ReportFile> render_latex(const ReportInput& input,
                                     const std::vector<NamedSection>& sections);

}  // namespace fracbench
