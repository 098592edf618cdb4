#include "harness/reference_agreement.h"

#include <map>
#include <tuple>

#include "core/adjusted_rand_index.h"
#include "geometry/fragment_labels.h"
#include "harness/record_store.h"

namespace fracbench {

namespace {

using Labels = std::vector<std::int32_t>;
/// Shape, then the impact.
using Impacted = std::tuple<std::string, std::string, std::string, int>;

Impacted impact_of(const CellSummary& cell) {
  return {cell.shape, cell.family, cell.scenario, cell.repeat};
}

}  // namespace

std::vector<LabelAgreement> agreement_with_reference(const std::filesystem::path& folder,
                                                     const std::vector<CellSummary>& cells,
                                                     const AgreementOptions& options) {
  const auto labels_of = [&](const CellSummary& cell) {
    const Record record = read_record(folder, cell.key);
    return fragment_labels(record.outcome.scene.fragments,
                           unit_grid<std::int32_t>(options.resolution), options.threads)
        .values;
  };
  std::map<Impacted, Labels> reference;
  for (const CellSummary& cell : cells) {
    if (cell.status != CellStatus::ok || cell.label != options.reference) continue;
    reference.emplace(impact_of(cell), labels_of(cell));
  }
  std::vector<LabelAgreement> result;
  const auto add = [&](const CellSummary& cell, bool other_impact, const Labels& a,
                       const Labels& b) {
    result.push_back({.shape = cell.shape,
                      .label = cell.label,
                      .family = cell.family,
                      .scenario = cell.scenario,
                      .repeat = cell.repeat,
                      .other_impact = other_impact,
                      .index = adjusted_rand_index(a, b)});
  };
  for (const CellSummary& cell : cells) {
    const auto same = reference.find(impact_of(cell));
    if (cell.status != CellStatus::ok || same == reference.end()) continue;
    if (cell.label != options.reference) {
      add(cell, false, same->second, labels_of(cell));
      continue;
    }
    // The next impact on this shape, in a ring.
    auto next = std::next(same);
    if (next == reference.end() || std::get<0>(next->first) != cell.shape) {
      next = reference.lower_bound({cell.shape, "", "", 0});
    }
    if (next != same) add(cell, true, same->second, next->second);
  }
  return result;
}

}  // namespace fracbench
