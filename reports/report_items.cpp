#include "reports/report_items.h"

#include "reports/items/claims.h"
#include "reports/items/errata_table.h"
#include "reports/items/fracture_gallery.h"
#include "reports/items/fracture_surfaces.h"
#include "reports/items/fragment_counts.h"
#include "reports/items/impulse_response.h"
#include "reports/items/label_agreement.h"
#include "reports/items/overview.h"
#include "reports/items/paper_tables.h"
#include "reports/items/representations.h"
#include "reports/items/resolution_times.h"
#include "reports/items/stage_times_table.h"
#include "reports/items/training.h"
#include "reports/items/validity_table.h"
#include "reports/items/volume_distribution.h"

namespace fracbench {

const std::vector<std::unique_ptr<ReportItem>>& report_items() {
  static const auto all = [] {
    std::vector<std::unique_ptr<ReportItem>> list;
    list.push_back(std::make_unique<Overview>());
    list.push_back(std::make_unique<ClaimsTable>());
    list.push_back(std::make_unique<FractureGallery>());
    list.push_back(std::make_unique<ValidityTable>());
    list.push_back(std::make_unique<FragmentCounts>());
    list.push_back(std::make_unique<VolumeDistribution>());
    list.push_back(std::make_unique<ImpulseResponse>());
    list.push_back(std::make_unique<FractureSurfaces>());
    list.push_back(std::make_unique<LabelAgreementTable>());
    list.push_back(std::make_unique<Training>());
    list.push_back(std::make_unique<Representations>());
    list.push_back(std::make_unique<StageTimesTable>());
    list.push_back(std::make_unique<ResolutionTimes>());
    list.push_back(std::make_unique<PaperTables>());
    list.push_back(std::make_unique<ErrataTable>());
    return list;
  }();
  return all;
}

}  // namespace fracbench
