#include "geometry/partition/label_lattice.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/line_crossing.h"
#include "geometry/measures.h"

namespace fracbench::partition {
namespace {

// Beyond the mesh the interfaces reach two cells at least, so that what happens at their rim does
// not show at the surface; one more layer is void.
constexpr int padding = 4;
constexpr double largest_lattice = 1 << 28;  // samples; 1 GB of regions

void check_grid(const VoxelGrid<std::int32_t>& labels) {
  for (int axis = 0; axis < 3; ++axis) {
    if (labels.size[axis] < 1) {
      throw InputError(fmt::format("label volume: size {} x {} x {}; every side must be at least 1",
                                   labels.size[0], labels.size[1], labels.size[2]));
    }
  }
  const double count = static_cast<double>(labels.size[0]) * labels.size[1] * labels.size[2];
  if (static_cast<double>(labels.values.size()) != count) {
    throw InputError(fmt::format("label volume: {} values for {} x {} x {} voxels",
                                 labels.values.size(), labels.size[0], labels.size[1],
                                 labels.size[2]));
  }
  if (!(labels.spacing > 0) || !std::isfinite(labels.spacing) || !labels.origin.allFinite()) {
    throw InputError(
        fmt::format("label volume: spacing {} m, origin ({}, {}, {}) m; the spacing "
                    "must be above 0 and both finite",
                    labels.spacing, labels.origin.x(), labels.origin.y(), labels.origin.z()));
  }
}

/// The mesh may reach beyond the outermost voxels, which end half a spacing beyond their samples,
/// by one voxel.
void check_placement(const BoundingBox& box, const VoxelGrid<std::int32_t>& labels) {
  const double margin = 1.5 * labels.spacing;
  const Vec3 low = labels.origin - Vec3::Constant(margin);
  const Vec3 high = labels.position(labels.size[0] - 1, labels.size[1] - 1, labels.size[2] - 1) +
                    Vec3::Constant(margin);
  if ((box.low.array() >= low.array()).all() && (box.high.array() <= high.array()).all()) return;
  throw InputError(fmt::format(
      "the mesh spans ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m, the label volume "
      "({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m: check origin and spacing of the "
      "volume, and whether the mesh is in the frame that it was made for",
      box.low.x(), box.low.y(), box.low.z(), box.high.x(), box.high.y(), box.high.z(), low.x(),
      low.y(), low.z(), high.x(), high.y(), high.z()));
}

/// 1 at the samples that lie inside the mesh.
std::vector<std::uint8_t> inside_samples(const TriangleMesh& mesh,
                                         const VoxelGrid<std::int32_t>& grid) {
  std::vector<std::int8_t> change(grid.values.size(), 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vec3 &a = mesh.corner(f, 0), &b = mesh.corner(f, 1), &c = mesh.corner(f, 2);
    const Vec3 low = (a.cwiseMin(b).cwiseMin(c) - grid.origin) / grid.spacing;
    const Vec3 high = (a.cwiseMax(b).cwiseMax(c) - grid.origin) / grid.spacing;
    const Vec3 n = (b - a).cross(c - a);
    for (int k = static_cast<int>(std::floor(low.z())); k <= high.z() + 1; ++k) {
      for (int j = static_cast<int>(std::floor(low.y())); j <= high.y() + 1; ++j) {
        const Vec3 row = grid.position(0, j, k);
        const int crossing = line_crossing(a, b, c, row.y(), row.z());
        if (crossing == 0) continue;
        double x = n.x() == 0
                       ? a.x()
                       : a.x() - (n.y() * (row.y() - a.y()) + n.z() * (row.z() - a.z())) / n.x();
        x = std::clamp((x - grid.origin.x()) / grid.spacing, low.x(), high.x());
        const int i = static_cast<int>(std::ceil(x));
        change[grid.index(i, j, k)] = static_cast<std::int8_t>(
            change[grid.index(i, j, k)] - crossing);  // entering the solid: crossing is -1
      }
    }
  }
  std::vector<std::uint8_t> inside(change.size(), 0);
  for (std::size_t row = 0; row < change.size(); row += grid.size[0]) {
    int winding = 0;
    for (std::size_t i = row; i < row + grid.size[0]; ++i) {
      winding += change[i];
      inside[i] = winding != 0;
    }
  }
  return inside;
}

/// 1 at the samples of cells that the surface touches, and of those next to them.
std::vector<std::uint8_t> samples_near_surface(const TriangleMesh& mesh,
                                               const VoxelGrid<std::int32_t>& grid, int threads) {
  std::vector<std::uint8_t> near(grid.values.size(), 0);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for_each_touched_cell(grid, mesh, f, [&](std::size_t cell) { near[cell] = 1; });
  }
  // Cell i has samples i and i + 1, its neighbours those from i - 1 to i + 2: one axis at a time.
  const std::array<std::size_t, 3> stride = {1, static_cast<std::size_t>(grid.size[0]),
                                             static_cast<std::size_t>(grid.size[0]) * grid.size[1]};
  const auto slabs = static_cast<std::size_t>(grid.size[2]);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint8_t> wide(near.size(), 0);
    const std::size_t step = stride[axis];
    parallel_for(
        slabs, threads,
        [&](std::size_t k) {
          const std::size_t begin = std::max(k * stride[2], 2 * step);
          const std::size_t end = std::min((k + 1) * stride[2], near.size() - step);
          for (std::size_t i = begin; i < end; ++i) {
            wide[i] = near[i - 2 * step] | near[i - step] | near[i] | near[i + step];
          }
        },
        8);
    near.swap(wide);
  }
  return near;
}

/// Gives every sample of `wanted` that has no region that of the nearest sample with one. Layer by
/// layer: a sample takes the nearest of the sources of its 26 neighbours.
void fill_nearest(VoxelGrid<std::int32_t>& region, const std::vector<std::uint8_t>& wanted) {
  const int nx = region.size[0], ny = region.size[1];
  const std::ptrdiff_t row = nx, slab = static_cast<std::ptrdiff_t>(nx) * ny;
  std::vector<std::int32_t> source(region.values.size(), -1);
  const std::array<std::ptrdiff_t, 6> steps = {-slab, -row, -1, 1, row, slab};
  const auto place = [&](std::ptrdiff_t i) {
    return std::array<std::int64_t, 3>{i % nx, i / row % ny, i / slab};
  };
  // The lowest and highest layers are void, so that neighbours of wanted samples exist.
  std::vector<std::int32_t> layer;
  for (std::size_t i = 0; i < region.values.size(); ++i) {
    if (!wanted[i] || region.values[i] != 0) continue;
    for (const std::ptrdiff_t step : steps) {
      if (region.values[i + step] > 0) {
        layer.push_back(static_cast<std::int32_t>(i));
        break;
      }
    }
  }
  std::vector<std::uint8_t> seen(region.values.size(), 0);
  for (const std::int32_t i : layer) seen[i] = 1;
  std::vector<std::int32_t> found, next;
  while (!layer.empty()) {
    found.assign(layer.size(), -1);
    for (std::size_t n = 0; n < layer.size(); ++n) {
      const auto here = place(layer[n]);
      std::int64_t best = std::numeric_limits<std::int64_t>::max();
      for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const std::ptrdiff_t other = layer[n] + dx + row * dy + slab * dz;
            if (region.values[other] == 0) continue;
            const std::int32_t from =
                source[other] >= 0 ? source[other] : static_cast<std::int32_t>(other);
            const auto there = place(from);
            std::int64_t distance = 0;
            for (int a = 0; a < 3; ++a) {
              distance += (here[a] - there[a]) * (here[a] - there[a]);
            }
            if (distance < best || (distance == best && from < found[n])) {
              best = distance;
              found[n] = from;
            }
          }
        }
      }
    }
    for (std::size_t n = 0; n < layer.size(); ++n) {
      source[layer[n]] = found[n];
      region.values[layer[n]] = region.values[found[n]];
    }
    next.clear();
    for (const std::int32_t i : layer) {
      for (const std::ptrdiff_t step : steps) {
        const std::ptrdiff_t other = i + step;
        if (!wanted[other] || seen[other] || region.values[other] != 0) continue;
        seen[other] = 1;
        next.push_back(static_cast<std::int32_t>(other));
      }
    }
    layer.swap(next);
  }
}

}  // namespace

LabelLattice make_lattice(const TriangleMesh& mesh, const VoxelGrid<std::int32_t>& labels,
                          int threads) {
  check_grid(labels);
  const BoundingBox box = bounding_box(mesh);
  check_placement(box, labels);

  std::array<std::int32_t, 3> base{}, size{};
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = (box.low[axis] - labels.origin[axis]) / labels.spacing;
    const double high = (box.high[axis] - labels.origin[axis]) / labels.spacing;
    base[axis] = static_cast<std::int32_t>(std::floor(low)) - padding;
    size[axis] = static_cast<std::int32_t>(std::floor(high)) + padding + 2 - base[axis];
    count *= size[axis];
  }
  if (count > largest_lattice) {
    throw InputError(
        fmt::format("the mesh covers {:.3g} voxels of the label volume; at most {:.3g} "
                    "can be handled: use a coarser volume",
                    count, largest_lattice));
  }
  LabelLattice lattice;
  lattice.region =
      VoxelGrid<std::int32_t>(size, labels.position(base[0], base[1], base[2]), labels.spacing);
  VoxelGrid<std::int32_t>& region = lattice.region;
  const std::vector<std::uint8_t> inside = inside_samples(mesh, region);
  std::vector<std::uint8_t> wanted = samples_near_surface(mesh, region, threads);
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] |= inside[i];

  // Which labels count: those with a voxel inside; where the whole mesh is thinner than a voxel,
  // those around it.
  struct Count {
    std::size_t inside = 0;
    std::int32_t region = 0;
  };
  std::map<std::int32_t, Count> counts;
  std::int32_t last_label = 0;
  Count* last = nullptr;
  const auto count_of = [&](std::int32_t label) -> Count& {
    if (!last || label != last_label) {
      last = &counts[label];
      last_label = label;
    }
    return *last;
  };
  bool any_inside = false, any_near = false;
  const auto for_each_sample = [&](const auto& visit) {
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        const int gj = j + base[1], gk = k + base[2];
        const bool row_in = gj >= 0 && gj < labels.size[1] && gk >= 0 && gk < labels.size[2];
        for (int i = 0; i < size[0]; ++i) {
          const std::size_t index = region.index(i, j, k);
          if (!wanted[index]) continue;
          const int gi = i + base[0];
          const bool in = row_in && gi >= 0 && gi < labels.size[0];
          visit(index, in ? labels.at(gi, gj, gk) : 0);
        }
      }
    }
  };
  for_each_sample([&](std::size_t index, std::int32_t label) {
    if (label <= 0) {
      lattice.filled_voxels += inside[index];
      return;
    }
    any_near = true;
    if (inside[index]) {
      any_inside = true;
      ++count_of(label).inside;
    }
  });
  if (!any_near) {
    throw InputError(
        "the label volume has no label (value above 0) inside the mesh: check its origin and "
        "spacing");
  }
  for_each_sample([&](std::size_t, std::int32_t label) {
    if (label <= 0) return;
    Count& c = count_of(label);
    if (!any_inside) ++c.inside;
  });
  for (auto& [label, c] : counts) {
    if (c.inside == 0) {
      lattice.labels_outside.push_back(label);
    } else {
      lattice.labels.push_back(label);
      c.region = static_cast<std::int32_t>(lattice.labels.size());
    }
  }
  for_each_sample([&](std::size_t index, std::int32_t label) {
    if (label > 0) region.values[index] = count_of(label).region;
  });

  fill_nearest(region, wanted);
  // A second body of the mesh may be out of reach along the mesh: then straight through the void.
  bool reached = true;
  for (std::size_t i = 0; i < wanted.size(); ++i) reached &= !wanted[i] || region.values[i] != 0;
  if (!reached) {
    std::vector<std::uint8_t> all(wanted.size(), 0);
    for (int k = 1; k + 1 < size[2]; ++k) {
      for (int j = 1; j + 1 < size[1]; ++j) {
        for (int i = 1; i + 1 < size[0]; ++i) all[region.index(i, j, k)] = 1;
      }
    }
    VoxelGrid<std::int32_t> everywhere = region;
    fill_nearest(everywhere, all);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (wanted[i]) region.values[i] = everywhere.values[i];
    }
  }
  return lattice;
}

}  // namespace fracbench::partition
