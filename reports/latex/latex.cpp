#include "reports/latex/latex.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "geometry/palette.h"

namespace fracbench {

namespace {

/// Characters beyond ASCII that reports use.
const std::map<std::string_view, std::string_view>& known_characters() {
  static const std::map<std::string_view, std::string_view> known{{"²", "\\textsuperscript{2}"},
                                                                  {"³", "\\textsuperscript{3}"},
                                                                  {"Σ", "$\\Sigma$"},
                                                                  {"π", "$\\pi$"},
                                                                  {"°", "$^{\\circ}$"},
                                                                  {"≥", "$\\ge$"},
                                                                  {"≤", "$\\le$"},
                                                                  {"∛", "$\\sqrt[3]{}$"},
                                                                  {"é", "\\'e"},
                                                                  {"á", "\\'a"},
                                                                  {"ö", "\\\"o"},
                                                                  {"ü", "\\\"u"}};
  return known;
}

std::size_t length_of_character(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

bool is_number(const TableCell& cell) {
  return !std::holds_alternative<std::monostate>(cell) &&
         !std::holds_alternative<std::string>(cell);
}

std::string cell_text(const TableCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return escape_latex(*text);
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *integer);
  if (const auto* real = std::get_if<double>(&cell)) return short_number(*real);
  if (const auto* e = std::get_if<Estimate>(&cell)) {
    return fmt::format("{} [{}, {}]", short_number(e->value), short_number(e->low),
                       short_number(e->high));
  }
  return "";
}

std::string heading(const TableColumn& column) {
  const std::string name = escape_latex(column.name);
  return column.unit.empty() ? name : fmt::format("{} [{}]", name, escape_latex(column.unit));
}

bool shows(double value, const FigureAxis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

std::string axis_options(const FigureAxis& axis, char name) {
  std::string options = fmt::format("{}label={{{}}}, ", name, escape_latex(axis.label));
  if (axis.logarithmic) options += fmt::format("{}mode=log, ", name);
  if (axis.categories.empty()) return options;
  std::string ticks;
  std::string labels;
  for (std::size_t i = 0; i < axis.categories.size(); ++i) {
    ticks += fmt::format("{}{}", i ? "," : "", i);
    labels += fmt::format("{}{{{}}}", i ? "," : "", escape_latex(axis.categories[i]));
  }
  return options + fmt::format(
                       "{0}tick={{{1}}}, {0}ticklabels={{{2}}}, {0}ticklabel style={{rotate=30, "
                       "anchor=east}}, ",
                       name, ticks, labels);
}

std::string coordinates(const Figure& figure, const FigureSeries& series) {
  std::string text;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!shows(series.x[i], figure.x) || !shows(series.y[i], figure.y)) continue;
    text += fmt::format(" ({:.6g},{:.6g})", series.x[i], series.y[i]);
    if (series.mark != Mark::intervals) continue;
    const double up = series.high[i] - series.y[i];
    const double down = series.y[i] - series.low[i];
    text += fmt::format(" += (0,{:.6g}) -= (0,{:.6g})", std::isfinite(up) ? up : 0,
                        std::isfinite(down) ? down : 0);
  }
  return text;
}

}  // namespace

std::string escape_latex(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = std::min(length_of_character(text[i]), text.size() - i);
    const std::string_view character = text.substr(i, length);
    i += length;
    if (length > 1) {
      const auto known = known_characters().find(character);
      result += known == known_characters().end() ? "?" : known->second;
      continue;
    }
    switch (const char c = character[0]) {
      case '\\':
        result += "\\textbackslash{}";
        break;
      case '~':
        result += "\\textasciitilde{}";
        break;
      case '^':
        result += "\\textasciicircum{}";
        break;
      case '<':
        result += "\\textless{}";
        break;
      case '>':
        result += "\\textgreater{}";
        break;
      case '|':
        result += "\\textbar{}";
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        result += fmt::format("\\{}", c);
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return result;
}

std::string to_latex(const Table& table) {
  std::string columns;
  std::string head;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool numbers =
        std::ranges::any_of(table.rows, [&](const auto& row) { return is_number(row[c]); });
    columns += numbers ? 'r' : 'l';
    head += fmt::format("{}{}", c ? " & " : "", heading(table.columns[c]));
  }
  std::string latex = fmt::format("% {}\n\\begin{{tabular}}{{{}}}\n\\toprule\n{} \\\\\n\\midrule\n",
                                  escape_latex(table.title), columns, head);
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      // A row must not begin with a bracket, which would belong to the line before.
      latex += fmt::format("{}{{{}}}", c ? " & " : "", cell_text(row[c]));
    }
    latex += " \\\\\n";
  }
  return latex + "\\bottomrule\n\\end{tabular}\n";
}

std::string to_pgfplots(const Figure& figure) {
  std::string plots;
  std::vector<std::string> named;
  for (const FigureSeries& series : figure.series) {
    const std::string points = coordinates(figure, series);
    if (points.empty()) continue;
    const Vec3 colour = fragment_color(series.colour);
    std::string style = fmt::format("color={{rgb,1:red,{:.3f};green,{:.3f};blue,{:.3f}}}, ",
                                    colour.x(), colour.y(), colour.z());
    style += series.mark == Mark::line ? "mark=none, thick" : "only marks, mark=*, mark size=1.5pt";
    if (series.dashed) style += ", dashed";
    if (series.faint) style += ", opacity=0.4";
    if (series.mark == Mark::intervals) {
      style += ", error bars/.cd, y dir=both, y explicit";
    }
    const bool in_legend =
        !series.name.empty() && std::ranges::find(named, series.name) == named.end();
    plots += fmt::format("\\addplot+[{}{}] coordinates {{{} }};\n",
                         in_legend ? "" : "forget plot, ", style, points);
    if (!in_legend) continue;
    named.push_back(series.name);
    plots += fmt::format("\\addlegendentry{{{}}}\n", escape_latex(series.name));
  }
  if (plots.empty()) return "";
  return fmt::format(
      "% {}\n\\begin{{tikzpicture}}\n\\begin{{axis}}[{}{}width=0.8\\linewidth, "
      "height=0.5\\linewidth, "
      "grid=major, legend style={{at={{(0.5,-0.28)}}, anchor=north, draw=none, "
      "legend columns=4}}]\n{}\\end{{axis}}\n\\end{{tikzpicture}}\n",
      escape_latex(figure.title), axis_options(figure.x, 'x'), axis_options(figure.y, 'y'), plots);
}

}  // namespace fracbench
