#include "reports/sections.h"

#include <algorithm>
#include <thread>

#include "core/parallel.h"
#include "reports/report_items.h"

namespace fracbench {

std::vector<NamedSection> render_sections(const ReportInput& input) {
  const auto& items = report_items();
  std::vector<NamedSection> sections(items.size());
  const auto threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  parallel_for(items.size(), threads, [&](std::size_t i) {
    sections[i] = {.item = items[i]->info(), .section = items[i]->render(input)};
  });
  std::erase_if(sections, [](const NamedSection& named) { return named.section.empty(); });
  return sections;
}

}  // namespace fracbench
