#include "methods/bem/cut_links.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "core/available_memory.h"
#include "core/error.h"
#include "core/parallel.h"
#include "geometry/components.h"
#include "geometry/line_crossing.h"
#include "geometry/measures.h"
#include "geometry/shell_nesting.h"

namespace fracbench::bem {
namespace {

constexpr int kPadding = 2;  // voxels around the body's box: cracks overshoot its surface
constexpr double kMostVoxels = 1 << 28;
// One byte for inside, two for each link, four for a label and as many again while joining.
constexpr double kBytesPerVoxel = 16;

// Where a sample lies in its voxel, as shares of the spacing: off every plane of symmetry.
const Vec3 kOffset(0.06180339887, 0.04142135624, 0.07320508076);

// The voxels must hold the body's volume to this share, and be in one part but for this share.
constexpr double kVolumeTolerance = 0.4;
constexpr double kChipShare = 0.01;
constexpr double kFiner = 0.75;  // factor from one spacing that is tried to the next
constexpr double kMostVoxelsForAdvice = 1.5e7;

VoxelGrid<std::uint8_t> grid_around(const BoundingBox& box, double spacing) {
  const Vec3 extent = box.high - box.low;
  std::array<std::int32_t, 3> size{};
  double count = 1;
  for (int a = 0; a < 3; ++a) {
    const double samples = std::ceil(extent[a] / spacing) + 2 * kPadding;
    count *= samples;
    size[a] = static_cast<std::int32_t>(std::min(samples, kMostVoxels));
  }
  const double bytes = count * kBytesPerVoxel;
  if (const auto available = static_cast<double>(available_memory());
      count > kMostVoxels || bytes > available) {
    throw InputError(fmt::format(
        "voxels of {:.4g} m: {:.3g} of them cover the body and take {:.1f} GB, of at most {:.3g} "
        "voxels and {:.1f} GB available; use voxels of {:.3g} m or more",
        spacing, count, bytes / 1e9, kMostVoxels, available / 1e9,
        spacing * std::cbrt(std::max(count / kMostVoxels, bytes / available)) * 1.05));
  }
  const Vec3 middle(0.5 * (size[0] - 1), 0.5 * (size[1] - 1), 0.5 * (size[2] - 1));
  return VoxelGrid<std::uint8_t>(size, box.center() - spacing * (middle + kOffset), spacing);
}

/// A line of samples along one axis that a triangle crosses.
struct LineCrossing {
  std::int64_t line;    ///< index of the line's first sample
  std::int32_t beyond;  ///< place along the line of the first sample beyond the triangle
  int direction;        ///< see line_crossing
};

/// Calls visit(LineCrossing) for every line of samples along `axis` that the triangle crosses.
template <typename Visit>
void for_each_crossing(const VoxelGrid<std::uint8_t>& grid,
                       const std::array<std::size_t, 3>& stride,
                       const std::array<Vec3, 3>& triangle, int axis, const Visit& visit) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::array<Vec3, 3> p;
  for (int c = 0; c < 3; ++c) p[c] = Vec3(triangle[c][axis], triangle[c][u], triangle[c][v]);
  const Vec3 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]), high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
  const auto coordinate = [&](int a, int i) { return grid.origin[a] + grid.spacing * i; };
  // The outermost samples that can lie between two coordinates; one more for rounding.
  const auto first = [&](int a, double x) {
    return static_cast<int>(
        std::clamp(std::floor((x - grid.origin[a]) / grid.spacing), -1.0, 1.0 * grid.size[a]));
  };
  const Vec3 n = (p[1] - p[0]).cross(p[2] - p[0]);
  const int j_end = std::min(first(u, high[1]) + 1, grid.size[u] - 1);
  const int k_end = std::min(first(v, high[2]) + 1, grid.size[v] - 1);
  for (int k = std::max(first(v, low[2]), 0); k <= k_end; ++k) {
    const double z = coordinate(v, k);
    if (z < low[2] || z > high[2]) continue;
    for (int j = std::max(first(u, low[1]), 0); j <= j_end; ++j) {
      const double y = coordinate(u, j);
      const int crossing = line_crossing(p[0], p[1], p[2], y, z);
      if (crossing == 0) continue;
      double x =
          n[0] == 0 ? p[0][0] : p[0][0] - (n[1] * (y - p[0][1]) + n[2] * (z - p[0][2])) / n[0];
      x = std::clamp(x, low[0], high[0]);
      int i = std::max(first(axis, x) + 1, 0);  // about the first sample beyond: now exactly
      const auto beyond = [&](int at) {
        return is_beyond(p[0], p[1], p[2], crossing, Vec3(coordinate(axis, at), y, z));
      };
      while (i > 0 && beyond(i - 1)) --i;
      while (i < grid.size[axis] && !beyond(i)) ++i;
      visit(LineCrossing{static_cast<std::int64_t>(stride[u] * j + stride[v] * k), i, crossing});
    }
  }
}

std::array<Vec3, 3> corners(const TriangleMesh& mesh, std::size_t f) {
  return {mesh.corner(f, 0), mesh.corner(f, 1), mesh.corner(f, 2)};
}

std::int32_t root_of(std::vector<std::int32_t>& parent, std::int32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

void unite(std::vector<std::int32_t>& parent, std::int32_t a, std::int32_t b) {
  a = root_of(parent, a);
  b = root_of(parent, b);
  if (a != b) parent[std::max(a, b)] = std::min(a, b);
}

/// Voxels of every component, by number; [0]: outside.
std::vector<std::int64_t> sizes_of(const VoxelGrid<std::int32_t>& components) {
  std::vector<std::int64_t> sizes(1, 0);
  for (const std::int32_t c : components.values) {
    if (c >= static_cast<std::int32_t>(sizes.size())) sizes.resize(c + 1, 0);
    ++sizes[c];
  }
  return sizes;
}

std::size_t solid_parts(const TriangleMesh& body) {
  std::size_t parts = 0;
  for (const auto& shell : shell_nesting(body, face_components(body)).shells) {
    parts += shell.depth % 2 == 0;
  }
  return parts;
}

}  // namespace

CutLinks::CutLinks(const TriangleMesh& body, double spacing, int) {
  if (!(spacing > 0) || !std::isfinite(spacing)) {
    throw InputError(fmt::format("voxels of {} m: the size must be above 0", spacing));
  }
  const BoundingBox box = bounding_box(body);
  const double solid = volume(body), mean_thickness = 2 * solid / area(body);
  const std::size_t parts = solid_parts(body);
  VoxelGrid<std::int32_t> uncut;
  const auto too_thin = [&]() -> std::string {
    if (mean_thickness < inside_.spacing) {
      return fmt::format("it is about {:.3g} m thick on average", mean_thickness);
    }
    uncut = components();
    const std::vector<std::int64_t> sizes = sizes_of(uncut);
    const std::int64_t all = std::accumulate(sizes.begin() + 1, sizes.end(), std::int64_t{0});
    const double held = static_cast<double>(all) * std::pow(inside_.spacing, 3) / solid;
    if (std::abs(held - 1) > kVolumeTolerance) {
      return fmt::format("the voxels hold {:.0f} % of its volume", 100 * held);
    }
    std::vector<std::int64_t> largest(sizes.begin() + 1, sizes.end());
    std::sort(largest.rbegin(), largest.rend());
    std::int64_t chips = 0;
    for (std::size_t n = parts; n < largest.size(); ++n) chips += largest[n];
    if (largest.size() < parts || static_cast<double>(chips) > kChipShare * all) {
      return fmt::format("the voxels fall into {} parts where the body has {}", largest.size(),
                         parts);
    }
    return {};
  };
  inside_ = grid_around(box, spacing);
  scan(body);
  if (const std::string reason = too_thin(); !reason.empty()) {
    // The first finer spacing that passes, for the message.
    const Vec3 extent = box.high - box.low;
    double finer = std::min(kFiner * spacing, mean_thickness);
    for (; extent.prod() / std::pow(finer, 3) < kMostVoxelsForAdvice; finer *= kFiner) {
      inside_ = grid_around(box, finer);
      scan(body);
      if (too_thin().empty()) {
        throw InputError(
            fmt::format("the body is thinner than voxels of {:.4g} m ({}); voxels of {:.3g} m do",
                        spacing, reason, std::floor(finer * 1e5) / 1e5));
      }
    }
    throw InputError(
        fmt::format("the body is thinner than voxels of {:.4g} m ({}), and voxels of {:.3g} m do "
                    "not do either: it cannot be handled by this method",
                    spacing, reason, finer / kFiner));
  }
  join_chips(uncut, parts);
}

void CutLinks::scan(const TriangleMesh& body) {
  stride_ = {1, static_cast<std::size_t>(inside_.size[0]),
             static_cast<std::size_t>(inside_.size[0]) * inside_.size[1]};
  const std::size_t count = inside_.values.size();
  for (auto& links : links_) links.assign(count, free_);
  // Entering the body (crossing -1) adds to the winding number of all samples beyond.
  std::vector<std::int8_t> change(count, 0);
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    for (int axis = 0; axis < 3; ++axis) {
      for_each_crossing(
          inside_, stride_, corners(body, f), axis, [&](const LineCrossing& crossing) {
            const std::size_t beyond = crossing.line + stride_[axis] * crossing.beyond;
            if (crossing.beyond < inside_.size[axis] && axis == 0) {
              change[beyond] = static_cast<std::int8_t>(change[beyond] - crossing.direction);
            }
            if (crossing.beyond > 0) links_[axis][beyond - stride_[axis]] = surface_;
          });
    }
  }
  const auto length = static_cast<std::size_t>(inside_.size[0]);
  for (std::size_t row = 0; row < count; row += length) {
    int winding = 0;
    for (std::size_t i = row; i < row + length; ++i) {
      winding += change[i];
      inside_.values[i] = winding > 0;
    }
  }
}

/// Parts of the uncut body that no link joins to the rest, because the neck between is finer than
/// a voxel, are joined to the nearest voxel of another part.
void CutLinks::join_chips(const VoxelGrid<std::int32_t>& parts, std::size_t solids) {
  const std::vector<std::int64_t> sizes = sizes_of(parts);
  if (sizes.size() <= solids + 1) return;
  std::vector<std::int32_t> order(sizes.size() - 1);
  std::iota(order.begin(), order.end(), 1);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::int32_t a, std::int32_t b) { return sizes[a] > sizes[b]; });
  std::vector<std::uint8_t> chip(sizes.size(), 0);
  for (std::size_t n = solids; n < order.size(); ++n) chip[order[n]] = 1;

  std::vector<std::vector<std::int32_t>> voxels(sizes.size());
  for (std::size_t i = 0; i < parts.values.size(); ++i) {
    if (chip[parts.values[i]]) voxels[parts.values[i]].push_back(static_cast<std::int32_t>(i));
  }
  const auto place = [&](std::int32_t i) {
    return std::array<std::int32_t, 3>{i % inside_.size[0], i / inside_.size[0] % inside_.size[1],
                                       static_cast<std::int32_t>(i / stride_[2])};
  };
  // Largest chips first, each to what is joined already: so the bridges make one body.
  for (std::size_t n = solids; n < order.size(); ++n) {
    const std::int32_t own = order[n];
    std::int64_t best = std::numeric_limits<std::int64_t>::max();
    std::array<std::int32_t, 2> bridge{-1, -1};
    for (int reach = 2; bridge[0] < 0; reach *= 2) {
      for (const std::int32_t from : voxels[own]) {
        const auto at = place(from);
        std::array<std::int32_t, 3> low{}, high{};
        for (int a = 0; a < 3; ++a) {
          low[a] = std::max(at[a] - reach, 0);
          high[a] = std::min(at[a] + reach, inside_.size[a] - 1);
        }
        for (int k = low[2]; k <= high[2]; ++k) {
          for (int j = low[1]; j <= high[1]; ++j) {
            for (int i = low[0]; i <= high[0]; ++i) {
              const std::size_t to = inside_.index(i, j, k);
              const std::int32_t other = parts.values[to];
              if (other == 0 || other == own || chip[other]) continue;
              const std::int64_t di = i - at[0], dj = j - at[1], dk = k - at[2];
              const std::int64_t distance = di * di + dj * dj + dk * dk;
              if (distance >= best) continue;
              best = distance;
              bridge = {from, static_cast<std::int32_t>(to)};
            }
          }
        }
      }
    }
    bridges_.push_back(bridge);
    chip[own] = 0;
  }
}

bool CutLinks::inside(const Vec3& point) const {
  std::array<int, 3> at{};
  for (int a = 0; a < 3; ++a) {
    const double i = std::round((point[a] - inside_.origin[a]) / inside_.spacing);
    if (!(i >= 0) || i > inside_.size[a] - 1) return false;
    at[a] = static_cast<int>(i);
  }
  return inside_.at(at[0], at[1], at[2]) != 0;
}

void CutLinks::cut(const std::array<Vec3, 3>& triangle, std::int32_t crack) {
  if (crack < 0 || crack > std::numeric_limits<CrackId>::max()) {
    throw MethodFailure(fmt::format("bem: crack {} where at most {} can be told apart", crack,
                                    std::numeric_limits<CrackId>::max() + 1));
  }
  for (int axis = 0; axis < 3; ++axis) {
    for_each_crossing(inside_, stride_, triangle, axis, [&](const LineCrossing& crossing) {
      if (crossing.beyond == 0) return;
      CrackId& link = links_[axis][crossing.line + stride_[axis] * (crossing.beyond - 1)];
      if (link == free_) link = static_cast<CrackId>(crack);
    });
  }
}

std::vector<std::array<std::int32_t, 2>> CutLinks::crossed_by(
    const std::array<Vec3, 3>& triangle) const {
  std::vector<std::array<std::int32_t, 2>> result;
  for (int axis = 0; axis < 3; ++axis) {
    for_each_crossing(inside_, stride_, triangle, axis, [&](const LineCrossing& crossing) {
      if (crossing.beyond == 0 || crossing.beyond >= inside_.size[axis]) return;
      const std::size_t to = crossing.line + stride_[axis] * crossing.beyond;
      const std::size_t from = to - stride_[axis];
      if (!inside_.values[from] || !inside_.values[to]) return;
      result.push_back({static_cast<std::int32_t>(from), static_cast<std::int32_t>(to)});
    });
  }
  return result;
}

std::int32_t CutLinks::crack_between(const Vec3& from, const Vec3& to, std::int32_t own) const {
  // From voxel to voxel along the way (Amanatides and Woo 1987); voxel i reaches from i - 1/2 to
  // i + 1/2 spacings.
  const Vec3 a = (from - inside_.origin) / inside_.spacing;
  const Vec3 way = (to - from) / inside_.spacing;
  std::array<std::int64_t, 3> at{}, end{};
  std::array<double, 3> next{};
  std::int64_t steps = 0;
  for (int c = 0; c < 3; ++c) {
    at[c] = static_cast<std::int64_t>(std::floor(a[c] + 0.5));
    end[c] = static_cast<std::int64_t>(std::floor(a[c] + way[c] + 0.5));
    steps += std::abs(end[c] - at[c]);
    const double wall = static_cast<double>(at[c]) + (way[c] > 0 ? 0.5 : -0.5);
    next[c] = end[c] == at[c] ? std::numeric_limits<double>::infinity() : (wall - a[c]) / way[c];
  }
  while (steps-- > 0) {
    int axis = next[0] <= next[1] ? 0 : 1;
    if (next[2] < next[axis]) axis = 2;
    const bool up = way[axis] > 0;
    std::array<std::int64_t, 3> lower = at;
    if (!up) --lower[axis];
    bool in_grid = true;
    for (int c = 0; c < 3; ++c) {
      in_grid = in_grid && lower[c] >= 0 && lower[c] < inside_.size[c] - (c == axis);
    }
    if (in_grid) {
      const CrackId crack =
          links_[axis][stride_[0] * lower[0] + stride_[1] * lower[1] + stride_[2] * lower[2]];
      if (crack >= 0 && crack != own) return crack;
    }
    at[axis] += up ? 1 : -1;
    next[axis] = at[axis] == end[axis] ? std::numeric_limits<double>::infinity()
                                       : next[axis] + 1 / std::abs(way[axis]);
  }
  return -1;
}

VoxelGrid<std::int32_t> CutLinks::components() const {
  VoxelGrid<std::int32_t> result(inside_.size, inside_.origin, inside_.spacing, 0);
  std::vector<std::int32_t>& parent = result.values;
  const auto count = static_cast<std::int32_t>(parent.size());
  for (std::int32_t i = 0; i < count; ++i) parent[i] = i;
  for (std::int32_t i = 0; i < count; ++i) {
    if (!inside_.values[i]) continue;
    // The grid's outermost layers are outside the body, so that the next voxel exists.
    for (int axis = 0; axis < 3; ++axis) {
      if (joined(i, axis)) unite(parent, i, i + static_cast<std::int32_t>(stride_[axis]));
    }
  }
  for (const auto& [a, b] : bridges_) unite(parent, a, b);
  // A root is the first voxel of its component and comes before the others.
  std::int32_t next = 0;
  for (std::int32_t i = 0; i < count; ++i) {
    if (!inside_.values[i]) {
      parent[i] = 0;
    } else {
      parent[i] = parent[i] == i ? -(++next) : parent[parent[i]];
    }
  }
  for (std::int32_t& c : parent) c = -c;
  return result;
}

}  // namespace fracbench::bem
