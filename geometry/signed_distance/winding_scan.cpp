#include "geometry/signed_distance/winding_scan.h"

#include <algorithm>
#include <numeric>

#include "geometry/line_crossing.h"

namespace fracbench {
namespace {

/// Indices of the coordinates in [low, high], as a half-open range.
std::pair<int, int> range_within(const std::vector<double>& coordinates, double low, double high) {
  const auto begin = std::lower_bound(coordinates.begin(), coordinates.end(), low);
  const auto end = std::upper_bound(begin, coordinates.end(), high);
  return {static_cast<int>(begin - coordinates.begin()),
          static_cast<int>(end - coordinates.begin())};
}

}  // namespace

void WindingScan::sort_faces() {
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    const auto [low, high] =
        std::minmax({mesh_.corner(f, 0).z(), mesh_.corner(f, 1).z(), mesh_.corner(f, 2).z()});
    const auto [begin, end] = range_within(z_, low, high);
    for (int k = begin; k < end; ++k) faces_of_slice_[k].push_back(static_cast<std::int32_t>(f));
  }
}

std::vector<std::int32_t> WindingScan::slice(int k) const {
  // Each crossing changes the winding number of the samples beyond it.
  std::vector<std::int32_t> winding(row() * y_.size(), 0);
  for (const std::int32_t f : faces_of_slice_[k]) {
    const Vec3 &a = mesh_.corner(f, 0), &b = mesh_.corner(f, 1), &c = mesh_.corner(f, 2);
    const std::int32_t weight = weights_.empty() ? 1 : weights_[f];
    const auto [low, high] = std::minmax({a.y(), b.y(), c.y()});
    const auto [begin, end] = range_within(y_, low, high);
    for (int j = begin; j < end; ++j) {
      const int crossing = line_crossing(a, b, c, y_[j], z_[k]);
      if (crossing != 0) winding[row() * j + first_beyond(f, crossing, j, k)] -= crossing * weight;
    }
  }
  for (std::size_t j = 0; j < y_.size(); ++j) {
    const auto line = winding.begin() + static_cast<std::ptrdiff_t>(row() * j);
    std::partial_sum(line, line + static_cast<std::ptrdiff_t>(row()), line);
  }
  return winding;
}

/// The first sample of the line that is beyond the crossing.
std::size_t WindingScan::first_beyond(std::int32_t face, int crossing, int j, int k) const {
  const auto first = std::partition_point(x_.begin(), x_.end(), [&](double x) {
    return !is_beyond(mesh_.corner(face, 0), mesh_.corner(face, 1), mesh_.corner(face, 2), crossing,
                      Vec3(x, y_[j], z_[k]));
  });
  return static_cast<std::size_t>(first - x_.begin());
}

}  // namespace fracbench
