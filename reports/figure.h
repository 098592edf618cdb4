#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace fracbench {

/// One axis of a figure: numbers, or categories at 0, 1, 2, ...
struct FigureAxis {
  std::string label;  ///< with its unit, such as "volume [V_body = 10]"
  bool logarithmic = false;
  std::vector<std::string> categories = {};
};

enum class Mark {
  line,       ///< through the points in their order
  dots,       ///< a dot for each point
  intervals,  ///< a dot with a line from `low` to `high`
};

/// Points that belong together, in one colour.
struct FigureSeries {
  std::string name;        ///< in the legend; empty: not there
  std::size_t colour = 0;  ///< of fragment_color, so that a method has one colour in all figures
  Mark mark = Mark::line;
  bool dashed = false;
  bool faint = false;  ///< behind the others
  std::vector<double> x = {};
  std::vector<double> y = {};
  std::vector<double> low = {};  ///< of y; for intervals only
  std::vector<double> high = {};
};

/// A plot, which knows nothing of where it is shown. What is not finite, or not positive on a
/// logarithmic axis, is left out.
struct Figure {
  std::string name;   ///< of its file
  std::string title;  ///< above it
  std::vector<std::string> notes = {};
  FigureAxis x;
  FigureAxis y;
  std::vector<FigureSeries> series = {};
};

/// Part of the name of a figure's file: what is neither a letter, a digit nor one of ". + -"
/// becomes
/// "_".
std::string file_name_part(std::string text);

}  // namespace fracbench
