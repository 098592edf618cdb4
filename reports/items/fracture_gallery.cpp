#include "reports/items/fracture_gallery.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <ranges>

#include "reports/figure.h"

namespace fracbench {

ReportItemInfo FractureGallery::info() const {
  return {.name = "fracture_gallery", .title = "Fractures side by side"};
}

ReportSection FractureGallery::render(const ReportInput& input) const {
  ReportSection section;
  if (!input.gallery) return section;
  const std::vector<GalleryRow> rows = input.gallery();
  if (rows.empty()) return section;
  Table table{.name = "fracture_gallery",
              .title = "How finely these fracture surfaces are resolved",
              .notes = {"Both sides of every crack. A method without fragments left the body "
                        "whole under this impact."},
              .columns = {{"shape"},
                          {"scenario"},
                          {"method"},
                          {"fragments"},
                          {"fracture faces"},
                          {"fracture area", "m^2"},
                          {"mean edge", "m"}}};
  for (const GalleryRow& row : rows) {
    section.pictures.push_back(
        {.name = "fractures_" + file_name_part(row.shape),
         .title = fmt::format("{}: {}", row.shape, row.scenario),
         .notes = {fmt::format(
             "From the left: the collision, {}. Below the fragments, pulled "
             "apart, the fracture surface of the one that has most of it, and "
             "the edges of its faces.",
             fmt::join(row.surfaces | std::views::transform(&GallerySurface::label), ", "))},
         .picture = row.picture});
    for (const std::string& line : row.missing) section.pictures.back().notes.push_back(line);
    for (const GallerySurface& surface : row.surfaces) {
      const auto where_broken = [&](double value) {
        return number_or_nothing(surface.faces > 0 ? std::optional(value) : std::nullopt);
      };
      table.rows.push_back({row.shape, row.scenario, surface.label,
                            static_cast<std::int64_t>(surface.fragments),
                            static_cast<std::int64_t>(surface.faces), where_broken(surface.area),
                            where_broken(surface.edge)});
    }
  }
  section.tables.push_back(std::move(table));
  return section;
}

}  // namespace fracbench
