#include "reports/page/html_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "geometry/palette.h"
#include "reports/cell_groups.h"
#include "reports/picture/sheet.h"
#include "reports/svg.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

std::string cell_html(const TableCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) {
    return fmt::format("<td>{}</td>", escape_markup(*text));
  }
  const auto number = [](double value, std::string_view words) {
    return fmt::format("<td class=\"number\" data-value=\"{}\">{}</td>", value, words);
  };
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) {
    return number(static_cast<double>(*integer), fmt::format("{}", *integer));
  }
  if (const auto* real = std::get_if<double>(&cell)) return number(*real, short_number(*real));
  if (const auto* e = std::get_if<Estimate>(&cell)) {
    return number(e->value, fmt::format("{} <small>[{}, {}]</small>", short_number(e->value),
                                        short_number(e->low), short_number(e->high)));
  }
  return "<td></td>";
}

std::string table_html(const Table& table) {
  std::string html = fmt::format("<h3>{}</h3>\n", escape_markup(table.title));
  for (const std::string& note : table.notes) {
    html += fmt::format("<p class=\"note\">{}</p>\n", escape_markup(note));
  }
  if (table.in_text) {
    html += "<div class=\"scroll\"><table>\n<thead><tr>";
    for (const TableColumn& column : table.columns) {
      html += fmt::format("<th scope=\"col\">{}{}</th>", escape_markup(column.name),
                          column.unit.empty()
                              ? ""
                              : fmt::format(" <small>[{}]</small>", escape_markup(column.unit)));
    }
    html += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
      html += "<tr>";
      for (const TableCell& cell : row) html += cell_html(cell);
      html += "</tr>\n";
    }
    html += "</tbody></table></div>\n";
  }
  return html + fmt::format("<p><a href=\"{0}.csv\" download>{0}.csv</a></p>\n",
                            escape_markup(table.name));
}

std::string figure_html(const Figure& figure) {
  const std::string svg = to_svg(figure, {.stand_alone = false});
  if (svg.empty()) return "";
  std::string html =
      fmt::format("<figure>\n{}<figcaption><strong>{}.</strong>", svg, escape_markup(figure.title));
  for (const std::string& note : figure.notes) html += fmt::format(" {}", escape_markup(note));
  return html + fmt::format(" <a href=\"{}.svg\" download>SVG</a></figcaption>\n</figure>\n",
                            escape_markup(figure.name));
}

std::string picture_html(const ReportPicture& picture) {
  std::string html = fmt::format(
      "<figure class=\"wide\"><img src=\"{0}.png\" width=\"{1}\" height=\"{2}\" loading=\"lazy\" "
      "alt=\"{3}\"><figcaption><strong>{3}.</strong>",
      escape_markup(picture.name), picture.picture.width, picture.picture.height,
      escape_markup(picture.title));
  for (const std::string& note : picture.notes) html += fmt::format(" {}", escape_markup(note));
  return html + "</figcaption></figure>\n";
}

std::string section_html(const NamedSection& named, const PageOptions& options) {
  std::string html = fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n", named.item.name,
                                 escape_markup(named.item.title));
  for (const std::string& paragraph : named.section.paragraphs) {
    html += fmt::format("<p>{}</p>\n", escape_markup(paragraph));
  }
  if (!named.section.figures.empty()) {
    html += "<div class=\"figures\">\n";
    for (const Figure& figure : named.section.figures) html += figure_html(figure);
    html += "</div>\n";
  }
  for (const ReportPicture& picture : named.section.pictures) html += picture_html(picture);
  for (const Table& table : named.section.tables) html += table_html(table);
  if (!options.commands.empty()) {
    html +=
        fmt::format("<details><summary>Make this section again</summary><pre>{}</pre></details>\n",
                    escape_markup(fmt::format("{}\n{} --items {}", options.commands.front(),
                                              options.commands.back(), named.item.name)));
  }
  return html + "</section>\n";
}

using CellPlace = std::tuple<std::string, std::string, std::string, int, std::string>;

/// The agreement of a cell with the reference, where it has one.
std::map<std::string, double> agreements_by_cell(const ReportInput& input) {
  std::map<CellPlace, double> by_place;
  for (const ReferenceAgreement& pair : input.agreements) {
    if (pair.other_impact) continue;
    by_place[{pair.shape, pair.family, pair.scenario, pair.repeat, pair.label}] =
        pair.agreement.partition.adjusted_rand;
  }
  std::map<std::string, double> result;
  for (const CellSummary& cell : input.cells) {
    const auto found =
        by_place.find({cell.shape, cell.family, cell.scenario, cell.repeat, cell.label});
    if (found != by_place.end()) result[cell.key] = found->second;
  }
  return result;
}

std::string cells_html(const ReportInput& input, const PageOptions& options) {
  const std::map<std::string, double> agreements = agreements_by_cell(input);
  std::string html = "<section id=\"cells\">\n<h2>Cells</h2>\n";
  if (options.cells > input.cells.size()) {
    html += fmt::format(
        "<p>The first collisions of each shape: {} of {} cells, here and in the viewer. Tables and "
        "figures are of all cells; <code>fracbench report --cells {}</code> shows all of them, "
        "in a larger page.</p>\n",
        input.cells.size(), options.cells, options.cells);
  }
  html += "<div class=\"scroll tall\"><table>\n<thead><tr>";
  for (const char* name : {"shape", "scenario", "repeat", "method", "status", "fragments",
                           "agreement", "time <small>[s]</small>", "record"}) {
    html += fmt::format("<th scope=\"col\">{}</th>", name);
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const CellSummary& cell : input.cells) {
    const auto agreement = agreements.find(cell.key);
    const bool seen = std::ranges::binary_search(options.viewed, cell.key);
    html += fmt::format("<tr{}>", seen ? fmt::format(" data-cell=\"{}\"", cell.key) : "");
    html += cell_html(cell.shape) + cell_html(cell.scenario) +
            cell_html(static_cast<std::int64_t>(cell.repeat)) + cell_html(cell.label) +
            fmt::format("<td title=\"{}\">{}</td>", escape_markup(cell.reason),
                        to_string(cell.status)) +
            cell_html(number_or_nothing(value_of(cell, "fragment_count"))) +
            cell_html(agreement == agreements.end() ? TableCell() : TableCell(agreement->second)) +
            cell_html(cell.total_seconds) +
            fmt::format("<td><code>{}</code>{}</td></tr>\n", cell.key.substr(0, 12),
                        seen && options.meshes
                            ? fmt::format(" <a href=\"cells/{}.glb\" download>glTF</a>", cell.key)
                            : "");
  }
  return html +
         "</tbody></table></div>\n<p><a href=\"cells.csv\" download>cells.csv</a> has every value "
         "of every cell, <a href=\"volumes.csv\" download>volumes.csv</a> the volume of every "
         "fragment. A record is the file <code>records/KEY.h5</code> of the results folder.</p>\n"
         "</section>\n";
}

std::string colour_text(const Vec3& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(255 * colour.x()),
                     std::lround(255 * colour.y()), std::lround(255 * colour.z()));
}

/// What the viewer knows before it loads a cell.
Json viewer_index(const ReportInput& input, const PageOptions& options) {
  Json index;
  constexpr std::size_t colours = 21;
  for (std::size_t i = 0; i < colours; ++i) {
    index["fragment_colours"].push_back(colour_text(fragment_color(i)));
  }
  index["fracture_colour"] = colour_text(fracture_color());
  index["cells"] = Json::array();
  for (const CellSummary& cell : input.cells) {
    if (!std::ranges::binary_search(options.viewed, cell.key)) continue;
    index["cells"].push_back({{"key", cell.key},
                              {"shape", cell.shape},
                              {"scenario", cell.scenario},
                              {"repeat", cell.repeat},
                              {"method", cell.label},
                              {"status", to_string(cell.status)},
                              {"fragments", value_of(cell, "fragment_count").value_or(0)}});
  }
  return index;
}

/// JSON inside a script element: nothing in it may look like the element's end.
std::string script_json(const Json& json) {
  std::string text = json.dump();
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

std::string viewer_html(const ReportInput& input, const PageOptions& options) {
  std::string html = "<section id=\"viewer\">\n<h2>Fragments</h2>\n";
  if (options.viewed.empty() || !options.script) {
    return html + (options.script ? "<p>There are no cells to look at.</p>\n</section>\n"
                                  : "<p>This fracbench was built without its viewer: see "
                                    "docs/report-page.md.</p>\n</section>\n");
  }
  html +=
      "<noscript><p>The viewer needs JavaScript.</p></noscript>\n<div id=\"viewer-place\"></div>\n"
      "</section>\n";
  return html + fmt::format("<script type=\"application/json\" id=\"viewer-index\">{}</script>\n",
                            script_json(viewer_index(input, options)));
}

/// One collision of each shape by every method.
std::string pictures_html(const ReportInput& input) {
  const std::vector<SheetRow> rows = sheet_rows(input.cells);
  const std::vector<std::string> columns = sheet_columns(input.cells, rows);
  std::string html = "<h3>One collision of each shape</h3>\n<div class=\"scroll pictures\">\n";
  for (const SheetRow& row : rows) {
    html += "<div>";
    for (const std::string& column : columns) {
      const auto cell = row.cells.find(column);
      if (cell == row.cells.end()) continue;
      html += fmt::format(
          "<figure data-cell=\"{}\"><img src=\"pictures/{}.png\" width=\"{}\" height=\"{}\" "
          "loading=\"lazy\" alt=\"\"><figcaption>{}: {}</figcaption></figure>",
          cell->second->key, picture_name(row, column), kThumbnail, kThumbnail,
          escape_markup(cell->second->shape), escape_markup(column));
    }
    html += "</div>\n";
  }
  return html + "</div>\n";
}

std::string provenance_html(const ReportInput& input, const PageOptions& options) {
  std::string html = "<section id=\"provenance\">\n<h2>Provenance</h2>\n<ul>\n";
  for (const std::string& line : input.provenance) {
    html += fmt::format("<li>{}</li>\n", escape_markup(line));
  }
  html += "<li>The suite with all values: <a href=\"suite.json\">suite.json</a></li>\n</ul>\n";
  if (!options.commands.empty()) {
    html += "<p>The same again:</p>\n<pre>";
    for (const std::string& line : options.commands) html += escape_markup(line) + "\n";
    html += "</pre>\n";
  }
  return html + "</section>\n";
}

}  // namespace

std::string html_page(const ReportInput& input, const std::vector<NamedSection>& sections,
                      const PageOptions& options) {
  const std::string title = escape_markup(input.title.empty() ? "Report" : input.title);
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0} - fracbench</title>\n<link rel=\"icon\" href=\"data:,\">\n"
      "<link rel=\"stylesheet\" href=\"page.css\">\n</head>\n<body>\n<header><h1>{0}</h1>",
      title);
  if (!input.provenance.empty()) {
    html += fmt::format("<p>{}</p>", escape_markup(input.provenance.front()));
  }
  html += "</header>\n<nav aria-label=\"Sections\"><ul>\n";
  if (!input.study) html += "<li><a href=\"#viewer\">Fragments</a></li>\n";
  for (const NamedSection& named : sections) {
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", named.item.name,
                        escape_markup(named.item.title));
  }
  if (!input.study) html += "<li><a href=\"#cells\">Cells</a></li>\n";
  html += "<li><a href=\"#provenance\">Provenance</a></li>\n</ul></nav>\n<main>\n";
  if (!input.study) {
    html += viewer_html(input, options);
    if (options.pictures) html += pictures_html(input);
    html += fmt::format(
        "<p class=\"note\">Intervals in brackets hold {:g} % and come from {} resamples of whole "
        "collisions.</p>\n",
        100 * input.bootstrap.confidence, input.bootstrap.resamples);
  }
  for (const NamedSection& named : sections) html += section_html(named, options);
  if (!input.study) html += cells_html(input, options);
  html += provenance_html(input, options) + "</main>\n";
  if (options.script) html += "<script src=\"page.js\"></script>\n";
  return html + "</body>\n</html>\n";
}

}  // namespace fracbench
