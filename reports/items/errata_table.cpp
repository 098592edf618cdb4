#include "reports/items/errata_table.h"

#include "reports/published.h"

namespace fracbench {

ReportItemInfo ErrataTable::info() const {
  return {.name = "errata", .title = "What is wrong or undefined in the paper"};
}

ReportSection ErrataTable::render(const ReportInput&) const {
  Table table{
      .name = "errata", .title = "Errata", .columns = {{"name"}, {"place"}, {"finding"}, {"here"}}};
  for (const Erratum& erratum : published_errata()) {
    table.rows.push_back({erratum.name, erratum.place, erratum.finding, erratum.consequence});
  }
  return {.paragraphs = {}, .tables = {table}};
}

}  // namespace fracbench
