#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/report_item.h"
#include "reports/sections.h"

namespace fracbench {

/// A report as files, by name.
struct ReportFile {
  std::string name;
  std::string bytes;
};

/// report.md with the sections, an SVG file for each figure, a CSV file for each table, and the raw
/// data cells.csv and volumes.csv. The same input gives the same bytes.
std::vector<ReportFile> render_report(const ReportInput& input,
                                      const std::vector<NamedSection>& sections);

/// Writes files below `folder`; folders are made where they are missing, and each file appears
/// whole or not at all. Returns the path of the last. Throws InputError where one cannot be
/// written.
std::filesystem::path write_files(const std::vector<ReportFile>& files,
                                  const std::filesystem::path& folder);

/// Writes those of render_report below `folder`, which is made where it is missing; each file
/// appears whole or not at all, report.md last. Returns its path. Throws InputError where it cannot
/// be written.
std::filesystem::path write_report(const ReportInput& input,
                                   const std::vector<NamedSection>& sections,
                                   const std::filesystem::path& folder);

}  // namespace fracbench
