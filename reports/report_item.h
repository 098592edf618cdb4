#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/cell_summary.h"
#include "harness/reference_agreement.h"
#include "metrics/cluster_bootstrap.h"
#include "neural/representation_study.h"
#include "reports/figure.h"
#include "reports/gallery.h"
#include "reports/report_picture.h"
#include "reports/table.h"

namespace fracbench {

/// Everything that a report is made from: the cells of a results folder, in the order of its plan.
struct ReportInput {
  std::string title = {};  ///< such as the suite's name
  std::vector<CellSummary> cells = {};
  /// Of a suite that has a study instead of cells.
  std::optional<neural::RepresentationStudy> study = {};
  std::vector<ReferenceAgreement> agreements = {};  ///< of the cells with the reference method
  /// Draws pictures of some of the cells; empty: there is nothing to draw.
  std::function<std::vector<GalleryRow>()> gallery = {};
  /// Lines about where the results come from (program, machine, suite), shown under the title.
  std::vector<std::string> provenance = {};
  std::string suite = {};  ///< all its values, as JSON; empty: not known
  BootstrapOptions bootstrap = {};
  std::uint64_t seed = 0;  ///< of the resampling; the same input and seed give the same bytes
};

struct ReportItemInfo {
  std::string name;
  std::string title;  ///< of its section
};

/// A section of the report: one table or figure and what belongs to it.
struct ReportSection {
  std::vector<std::string> paragraphs;
  std::vector<Table> tables;  ///< empty: there is nothing to show, and the section is left out
  std::vector<Figure> figures = {};
  std::vector<ReportPicture> pictures = {};

  bool empty() const { return tables.empty(); }
};

/// A table or figure of the report. Stateless, without input or output of its own; adding one is a
/// file pair below items/ and a line in report_items.cpp.
class ReportItem {
 public:
  virtual ~ReportItem() = default;
  virtual ReportItemInfo info() const = 0;
  virtual ReportSection render(const ReportInput& input) const = 0;
};

}  // namespace fracbench
