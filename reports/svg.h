#pragma once

#include <string>

#include "reports/figure.h"

namespace fracbench {

struct SvgOptions {
  double width = 640;       ///< px
  double height = 360;      ///< px, without the legend
  bool stand_alone = true;  ///< a file of its own, on white; else for a page, in the page's colours
};

/// The figure as SVG 1.1: axes with round ticks, grid lines, marks with their values as tool tips,
/// a legend below. The same figure gives the same bytes. Empty where there is no point to show.
std::string to_svg(const Figure& figure, const SvgOptions& options = {});

/// The text with what means something in XML and HTML replaced.
std::string escape_markup(std::string_view text);

}  // namespace fracbench
