#include "reports/sections.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"
#include "reports/report_items.h"

namespace fracbench {
namespace {

/// Throws InputError for a name that no item has.
std::vector<const ReportItem*> select_items(std::span<const std::string> names) {
  std::vector<const ReportItem*> selected;
  std::vector<std::string> known;
  for (const auto& item : report_items()) {
    known.push_back(item->info().name);
    if (names.empty() || std::ranges::find(names, known.back()) != names.end()) {
      selected.push_back(item.get());
    }
  }
  for (const std::string& name : names) {
    if (std::ranges::find(known, name) == known.end()) {
      throw InputError(
          fmt::format("--items: there is no item '{}'{}", name, did_you_mean(name, known)));
    }
  }
  return selected;
}

}  // namespace

std::vector<NamedSection> render_sections(const ReportInput& input,
                                          std::span<const std::string> names) {
  const std::vector<const ReportItem*> items = select_items(names);
  std::vector<NamedSection> sections(items.size());
  parallel_for(items.size(), hardware_threads(), [&](std::size_t i) {
    sections[i] = {.item = items[i]->info(), .section = items[i]->render(input)};
  });
  std::erase_if(sections, [](const NamedSection& named) { return named.section.empty(); });
  return sections;
}

}  // namespace fracbench
