#include "reports/items/fracture_surfaces.h"

#include "reports/cell_groups.h"

namespace fracbench {

ReportItemInfo FractureSurfaces::info() const {
  return {.name = "fracture_surfaces", .title = "Fracture surfaces"};
}

ReportSection FractureSurfaces::render(const ReportInput& input) const {
  Table table{.name = "fracture_surfaces",
              .title = "Normals in the impact frame, and roughness",
              .notes = {"Means over collisions. Isotropic surfaces have 0.5 along the impulse, "
                        "0.785 across it, and 1/3 for each eigenvalue of the fabric tensor; planar "
                        "cuts have roughness 0. These are this project's definitions: the paper "
                        "does not define its own."},
              .columns = {{"shape"},
                          {"method"},
                          {"along impulse"},
                          {"across impulse"},
                          {"fabric 1"},
                          {"fabric 2"},
                          {"fabric 3"},
                          {"roughness", "degree"}}};
  for (const CellGroup& group : group_cells(input.cells)) {
    const std::vector<CellRef> cells = broken_cells(group.cells);
    if (values_of(cells, "fabric_1").empty()) continue;
    auto& row = table.rows.emplace_back();
    row = {group.shape, group.label};
    for (const char* metric :
         {"normal_along", "normal_across", "fabric_1", "fabric_2", "fabric_3", "roughness"}) {
      row.push_back(estimated_mean(cells, metric, input));
    }
  }
  if (table.rows.empty()) return {};
  return {.paragraphs = {}, .tables = {table}};
}

}  // namespace fracbench
