#include "harness/label_agreement.h"

#include <map>
#include <string>
#include <tuple>

#include "harness/reference_agreement.h"

namespace fracbench {

void add_label_agreement(const std::filesystem::path& folder, Results& results) {
  using Place = std::tuple<std::string, std::string, std::string, std::string, int>;
  std::map<Place, double> agreement;
  for (const ReferenceAgreement& pair : agreement_with_reference(folder, results.cells)) {
    if (pair.other_impact) continue;
    agreement[{pair.shape, pair.label, pair.family, pair.scenario, pair.repeat}] =
        pair.agreement.partition.adjusted_rand;
  }
  for (CellSummary& cell : results.cells) {
    const auto found =
        agreement.find({cell.shape, cell.label, cell.family, cell.scenario, cell.repeat});
    if (found != agreement.end()) cell.values.push_back({kLabelAgreement, found->second, ""});
  }
}

}  // namespace fracbench
