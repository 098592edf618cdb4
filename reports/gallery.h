#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/cell_summary.h"
#include "reports/picture/picture.h"

namespace fracbench {

/// The fracture surface of one cell.
struct GallerySurface {
  std::string label;          ///< of the method
  std::size_t fragments = 0;  ///< 0: nothing broke
  std::size_t faces = 0;      ///< of the fracture surface, of all fragments
  double area = 0;            ///< likewise, m^2
  double edge = 0;            ///< mean length of the edges of these faces, m
};

/// One collision of a shape by every method, in the layout of figures 8 and 9 of the paper.
struct GalleryRow {
  std::string shape, scenario;
  /// Columns: the collision, then the methods. Rows: the fragments; the fracture surface of the
  /// fragment that has most of it; the same with the edges of its faces.
  Picture picture;
  std::vector<GallerySurface> surfaces;  ///< in the order of the columns
  std::vector<std::string> missing;      ///< what cannot be drawn, and why
};

/// Draws the collision of each shape that most methods broke it in (sheet_rows). `folder` is the
/// results folder that the cells are from.
std::vector<GalleryRow> gallery_of(const std::filesystem::path& folder,
                                   const std::vector<CellSummary>& cells);

}  // namespace fracbench
