#pragma once

#include <string>
#include <string_view>

#include "reports/figure.h"
#include "reports/table.h"

namespace fracbench {

/// The text with what means something in LaTeX replaced; Greek letters and other characters that a
/// plain pdflatex does not know become their commands or '?'.
std::string escape_latex(std::string_view text);

/// A tabular of the package booktabs, to be \input: numbers to the right, estimates as
/// "3.2 [2.9, 3.6]". Without caption or float, which belong to the paper.
std::string to_latex(const Table& table);

/// A tikzpicture of the package pgfplots, to be \input, in the colours of the SVG. Empty where
/// there is no point to show.
std::string to_pgfplots(const Figure& figure);

}  // namespace fracbench
