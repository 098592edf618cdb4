#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "methods/bem/crack_sheet.h"

namespace fracbench::bem {

/// A part of a sheet's boundary that ends at the body's surface: entries `first` to `last` of
/// CrackSheet::boundary (around the end of the list where last < first), all `at_surface`.
struct MouthRun {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// The longest such parts, in the order of the boundary, of three vertices or more (less has no
/// vertex with an opening between its ends). A sheet that ends at the surface all around has one
/// run from 0 to the last entry.
std::vector<MouthRun> mouth_runs(const CrackSheet& sheet);

/// The sheet with another mouth: the triangles at the run, and those nearer to `mouth` than about
/// half an edge, make room for a strip of triangles between what is left and `mouth` (points in the
/// order of the run, shape of the strip chosen for the best triangles). Other boundary vertices
/// keep their place; the new mouth is `at_surface`. Vertices are renumbered; `source` holds for
/// each entry of the new boundary that of the old one, or -1. Nothing where no proper strip can be
/// found.
struct RefitSheet {
  CrackSheet sheet;
  std::vector<std::int32_t> source;
};
std::optional<RefitSheet> refit_sheet(const CrackSheet& sheet, const MouthRun& run,
                                      std::span<const Vec3> mouth);

}  // namespace fracbench::bem
