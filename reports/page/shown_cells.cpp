#include "reports/page/shown_cells.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace fracbench {

std::vector<CellSummary> shown_cells(const std::vector<CellSummary>& cells, std::size_t most) {
  if (cells.size() <= most) return cells;
  std::map<Collision, std::size_t> sizes;
  for (const CellSummary& cell : cells) ++sizes[collision_of(cell)];
  // The first of every shape, the second of every shape, and so on.
  std::map<std::string, std::size_t> ranks;
  std::vector<std::pair<std::size_t, Collision>> order;
  for (const auto& [collision, size] : sizes) {
    order.emplace_back(ranks[std::get<0>(collision)]++, collision);
  }
  std::ranges::sort(order);
  std::set<Collision> chosen;
  std::size_t count = 0;
  for (const auto& [rank, collision] : order) {
    count += sizes[collision];
    if (count > most && !chosen.empty()) break;
    chosen.insert(collision);
  }
  std::vector<CellSummary> shown;
  std::ranges::copy_if(cells, std::back_inserter(shown), [&](const CellSummary& cell) {
    return chosen.contains(collision_of(cell));
  });
  return shown;
}

}  // namespace fracbench
