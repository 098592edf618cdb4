#include "reports/latex/write_latex.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "methods/registry.h"
#include "reports/latex/latex.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestTable = 40;

/// What a record calls its suite's values; empty for a report that knows no suite.
Json suite_values(const ReportInput& input) {
  Json json = Json::parse(input.suite, nullptr, false);
  return json.is_object() ? json : Json::object();
}

std::string option_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// "a = 1, b = x".
std::string options_text(const Json& options) {
  std::vector<std::string> list;
  for (const auto& [name, value] : options.items()) {
    list.push_back(fmt::format("{} = {}", name, option_text(value)));
  }
  return fmt::format("{}", fmt::join(list, ", "));
}

std::vector<std::string> methods_used(const ReportInput& input) {
  std::vector<std::string> names;
  for (const CellSummary& cell : input.cells) {
    if (std::ranges::find(names, cell.method) == names.end()) names.push_back(cell.method);
  }
  return names;
}

/// None where the program does not know the method.
std::vector<Publication> publications_of(const std::string& method) {
  for (const auto& known : methods()) {
    const MethodInfo info = known->info();
    if (info.name == method) return info.publications;
  }
  return {};
}

/// "~\\cite{a,b}", or nothing.
std::string citations(const std::string& method) {
  std::vector<std::string> keys;
  for (const Publication& publication : publications_of(method)) keys.push_back(publication.key);
  return keys.empty() ? "" : fmt::format("~\\cite{{{}}}", fmt::join(keys, ","));
}

std::string methods_paragraph(const ReportInput& input) {
  const Json suite = suite_values(input);
  std::string text = fmt::format("The suite \\texttt{{{}}} of fracbench was measured",
                                 escape_latex(suite.value("name", input.title)));
  if (suite.contains("study")) {
    return text + fmt::format(" with seed {}: a study with {}.\n", suite.value("seed", 1),
                              escape_latex(options_text(suite.at("study"))));
  }
  // Named, so that they live as long as their loops.
  const Json shape_values = suite.value("shapes", Json::object());
  const Json scenario_values = suite.value("scenarios", Json::object());
  const Json method_values = suite.value("methods", Json::object());
  std::vector<std::string> shapes;
  for (const auto& [label, shape] : shape_values.items()) {
    shapes.push_back(label);
  }
  if (!shapes.empty()) {
    text +=
        fmt::format(" on the shapes {}", escape_latex(fmt::format("{}", fmt::join(shapes, ", "))));
  }
  text += fmt::format(", with seed {} and {} repeat(s) of each method on each impact.\n",
                      suite.value("seed", 1), suite.value("repeats", 1));
  for (const auto& [label, scenario] : scenario_values.items()) {
    text += fmt::format("Impacts \\texttt{{{}}} are of the family \\texttt{{{}}} ({}).\n",
                        escape_latex(label), escape_latex(scenario.value("family", "")),
                        escape_latex(options_text(scenario.value("options", Json::object()))));
  }
  for (const auto& [label, method] : method_values.items()) {
    const std::string name = method.value("name", label);
    text += fmt::format("\\texttt{{{}}} is the method \\texttt{{{}}}{} with {}.\n",
                        escape_latex(label), escape_latex(name), citations(name),
                        escape_latex(options_text(method.value("options", Json::object()))));
  }
  return text;
}

/// The papers of every method used, each once.
std::string references(const ReportInput& input) {
  std::string bib;
  std::set<std::string> keys;
  for (const std::string& name : methods_used(input)) {
    for (const Publication& publication : publications_of(name)) {
      if (keys.insert(publication.key).second) bib += to_bibtex(publication) + '\n';
    }
  }
  return bib;
}

}  // namespace

std::vector<ReportFile> render_latex(const ReportInput& input,
                                     const std::vector<NamedSection>& sections) {
  std::vector<ReportFile> files;
  std::string report =
      "\\documentclass{article}\n\\usepackage[T1]{fontenc}\n\\usepackage[utf8]{inputenc}\n"
      "\\usepackage{booktabs,graphicx,pgfplots}\n\\usepackage[margin=2cm]{geometry}\n"
      "\\pgfplotsset{compat=1.18}\n\\newsavebox{\\content}\n"
      // What is wider than the page is made smaller.
      "\\newcommand{\\fitted}[1]{\\sbox{\\content}{\\input{#1}}"
      "\\ifdim\\wd\\content>\\linewidth\\resizebox{\\linewidth}{!}{\\usebox{\\content}}"
      "\\else\\usebox{\\content}\\fi}\n\\begin{document}\n";
  report += fmt::format("\\section*{{{}}}\n", escape_latex(input.title));
  report += "\\input{methods}\n";
  const auto add = [&](const std::string& name, std::string text, const std::string& title) {
    files.push_back({fmt::format("latex/{}.tex", name), std::move(text)});
    report += fmt::format("\\subsection*{{{}}}\n\n\\noindent\\fitted{{{}}}\n\n",
                          escape_latex(title), name);
  };
  for (const auto& [item, section] : sections) {
    report += fmt::format("\\section*{{{}}}\n", escape_latex(item.title));
    for (const Figure& figure : section.figures) {
      std::string plot = to_pgfplots(figure);
      if (!plot.empty()) add("figure-" + figure.name, std::move(plot), figure.title);
    }
    for (const ReportPicture& picture : section.pictures) {
      report += fmt::format(
          "\\subsection*{{{}}}\n\n\\noindent\\includegraphics[width=\\linewidth]{{../{}.png}}\n\n",
          escape_latex(picture.title), picture.name);
    }
    for (const Table& table : section.tables) {
      if (!table.in_text || table.rows.size() > kLongestTable) continue;
      add("table-" + table.name, to_latex(table), table.title);
    }
  }
  files.push_back({"latex/methods.tex", methods_paragraph(input)});
  files.push_back({"latex/references.bib", references(input)});
  report += "\\bibliographystyle{plain}\n\\bibliography{references}\n\\end{document}\n";
  files.push_back({"latex/report.tex", std::move(report)});
  return files;
}

}  // namespace fracbench
