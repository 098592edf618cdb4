#include "reports/sections.h"

#include "reports/report_items.h"

namespace fracbench {

std::vector<NamedSection> render_sections(const ReportInput& input) {
  std::vector<NamedSection> sections;
  for (const auto& item : report_items()) {
    NamedSection named{.item = item->info(), .section = item->render(input)};
    if (!named.section.empty()) sections.push_back(std::move(named));
  }
  return sections;
}

}  // namespace fracbench
