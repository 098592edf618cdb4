#include "reports/write_report.h"

#include <fmt/format.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "reports/picture/picture.h"
#include "reports/raw_data.h"
#include "reports/svg.h"

namespace fracbench {

namespace {

/// What has to be known to read the tables.
std::string introduction(const ReportInput& input) {
  if (input.study) return "\nEach table is a CSV file beside this one.\n";
  std::string text = fmt::format(
      "\nIntervals in brackets hold {:g} % and come from {} resamples of whole collisions. Each "
      "table is a CSV file beside this one; every value of every cell is in "
      "[cells.csv](cells.csv), "
      "the volume of every fragment in [volumes.csv](volumes.csv).\n",
      100 * input.bootstrap.confidence, input.bootstrap.resamples);
  if (input.cells.empty()) text += "\nThere are no cells to report on.\n";
  return text;
}

}  // namespace

std::vector<ReportFile> render_report(const ReportInput& input,
                                      const std::vector<NamedSection>& sections) {
  std::vector<ReportFile> files;
  std::string text = fmt::format("# {}\n", input.title.empty() ? "Report" : input.title);
  for (const std::string& line : input.provenance) text += fmt::format("\n- {}", line);
  if (!input.provenance.empty()) text += '\n';
  text += introduction(input);
  const auto add_csv = [&](const Table& table) {
    files.push_back({table.name + ".csv", to_csv(table)});
  };
  for (const auto& [item, section] : sections) {
    text += fmt::format("\n## {}\n", item.title);
    for (const std::string& paragraph : section.paragraphs)
      text += fmt::format("\n{}\n", paragraph);
    for (const Figure& figure : section.figures) {
      std::string svg = to_svg(figure);
      if (svg.empty()) continue;
      text += fmt::format("\n![{0}]({1}.svg)\n", figure.title, figure.name);
      for (const std::string& note : figure.notes) text += fmt::format("\n{}\n", note);
      files.push_back({figure.name + ".svg", std::move(svg)});
    }
    for (const ReportPicture& picture : section.pictures) {
      text += fmt::format("\n![{0}]({1}.png)\n", picture.title, picture.name);
      for (const std::string& note : picture.notes) text += fmt::format("\n{}\n", note);
      files.push_back({picture.name + ".png", png_bytes(picture.picture)});
    }
    for (const Table& table : section.tables) {
      add_csv(table);
      text += fmt::format("\n### {}\n", table.title);
      for (const std::string& note : table.notes) text += fmt::format("\n{}\n", note);
      if (table.in_text) text += fmt::format("\n{}", to_markdown(table));
      text += fmt::format("\n[{0}.csv]({0}.csv)\n", table.name);
    }
  }
  if (!input.study) {
    files.push_back({"cells.csv", cells_csv(input)});
    files.push_back({"volumes.csv", volumes_csv(input)});
  }
  files.push_back({"report.md", std::move(text)});
  return files;
}

std::filesystem::path write_files(const std::vector<ReportFile>& files,
                                  const std::filesystem::path& folder) {
  AtomicFiles written;
  std::filesystem::path last;
  for (const ReportFile& file : files) {
    last = folder / file.name;
    std::error_code error;
    std::filesystem::create_directories(last.parent_path(), error);
    if (error) {
      throw InputError(fmt::format("{}: the folder for the report cannot be made: {}",
                                   last.parent_path().string(), error.message()));
    }
    written.add(last, file.bytes);
  }
  written.commit();
  return last;
}

std::filesystem::path write_report(const ReportInput& input,
                                   const std::vector<NamedSection>& sections,
                                   const std::filesystem::path& folder) {
  return write_files(render_report(input, sections), folder);
}

}  // namespace fracbench
