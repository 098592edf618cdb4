#include "reports/gallery.h"

#include <fmt/format.h>

#include <optional>

#include "core/error.h"
#include "harness/record_store.h"
#include "reports/picture/record_picture.h"
#include "reports/picture/sheet.h"
#include "reports/scene_parts.h"

namespace fracbench {

namespace {

constexpr int kRows = 3;
constexpr int kSize = 320;  // of each picture in a row, px

GallerySurface surface_of(const std::string& label, const Fragments& fragments) {
  GallerySurface surface{.label = label, .fragments = fragments.size()};
  double edges = 0;
  for (const Fragment& fragment : fragments) {
    surface.area += fracture_area(fragment);
    for (std::size_t f = 0; f < fragment.faces.size(); ++f) {
      if (!fragment.faces[f].is_fracture()) continue;
      ++surface.faces;
      for (int k = 0; k < 3; ++k) {
        edges += (fragment.mesh.corner(f, (k + 1) % 3) - fragment.mesh.corner(f, k)).norm();
      }
    }
  }
  if (surface.faces > 0) surface.edge = edges / (3 * static_cast<double>(surface.faces));
  return surface;
}

GalleryRow row_of(const std::filesystem::path& folder, const SheetRow& sheet,
                  const std::vector<std::string>& columns) {
  GalleryRow row;
  std::vector<const CellSummary*> cells;
  for (const std::string& label : columns) {
    const auto cell = sheet.cells.find(label);
    if (cell != sheet.cells.end()) cells.push_back(cell->second);
  }
  row.shape = cells.front()->shape;
  row.scenario = cells.front()->scenario;
  row.picture = Picture(kSize * (1 + static_cast<int>(cells.size())), kSize * kRows);
  const RecordPictureOptions look{.width = kSize, .height = kSize};
  std::optional<TriangleMesh> target;
  int x = kSize;
  for (const CellSummary* cell : cells) {
    try {
      const Record record = read_record(folder, cell->key);
      if (!target) {
        target = read_target(folder, record.identity.shape_digest);
        paste(collision_picture_of(record, *target, look), 0, 0, row.picture);
      }
      paste(picture_of(record, *target, look), x, 0, row.picture);
      const Fragments& fragments = record.outcome.scene.fragments;
      if (const auto most = most_cracked(fragments)) {
        for (int detail = 1; detail < kRows; ++detail) {
          RecordPictureOptions close = look;
          close.wireframe = detail == 2;
          paste(fracture_picture_of(fragments[*most], close), x, kSize * detail, row.picture);
        }
      }
      row.surfaces.push_back(surface_of(cell->label, fragments));
    } catch (const DataError& error) {
      row.missing.push_back(fmt::format("{} cannot be drawn: {}", cell->label, error.what()));
      row.surfaces.push_back({.label = cell->label});
    }
    x += kSize;
  }
  return row;
}

}  // namespace

std::vector<GalleryRow> gallery_of(const std::filesystem::path& folder,
                                   const std::vector<CellSummary>& cells) {
  const std::vector<SheetRow> sheets = sheet_rows(cells);
  const std::vector<std::string> columns = sheet_columns(cells, sheets);
  std::vector<GalleryRow> rows;
  for (const SheetRow& sheet : sheets) rows.push_back(row_of(folder, sheet, columns));
  return rows;
}

}  // namespace fracbench
