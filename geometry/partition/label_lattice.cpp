#include "geometry/partition/label_lattice.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <map>

#include "core/available_memory.h"
#include "core/error.h"
#include "core/parallel.h"
#include "geometry/line_crossing.h"
#include "geometry/measures.h"

namespace fracbench::partition {
namespace {

// Beyond the mesh the interfaces reach two cells at least, so that what happens at their rim does
// not show at the surface; one more layer is void.
constexpr int padding = 4;
constexpr double bytes_per_sample = 40;      // measured: 35 with all interfaces of 20 regions
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
/// by one voxel, and by what rounding adds to it.
void check_placement(const BoundingBox& box, const VoxelGrid<std::int32_t>& labels) {
  const double margin = (1.5 + 1e-6) * labels.spacing;
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
                                         const VoxelGrid<std::int32_t>& grid, int threads) {
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
  const auto row_length = static_cast<std::size_t>(grid.size[0]);
  parallel_for(
      change.size() / row_length, threads,
      [&](std::size_t row) {
        int winding = 0;
        for (std::size_t i = row * row_length; i < (row + 1) * row_length; ++i) {
          winding += change[i];
          inside[i] = winding != 0;
        }
      },
      1024);
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
  if (layer.empty()) return;
  std::vector<std::int32_t> source(region.values.size(), -1);
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

/// Sets the regions of the wanted samples that have a label, and what the lattice knows of labels.
void take_labels(const VoxelGrid<std::int32_t>& labels, const std::array<std::int32_t, 3>& base,
                 const std::vector<std::uint8_t>& inside, const std::vector<std::uint8_t>& wanted,
                 int threads, LabelLattice& lattice) {
  VoxelGrid<std::int32_t>& region = lattice.region;
  const auto slabs = static_cast<std::size_t>(region.size[2]);
  struct Slab {
    std::map<std::int32_t, std::size_t> inside;  // samples of each label; 0: only near the surface
    std::size_t unlabelled_inside = 0;
  };
  std::vector<Slab> found(slabs);
  // The label numbers first, in place of the regions.
  parallel_for(slabs, threads, [&](std::size_t k) {
    Slab& slab = found[k];
    std::int32_t last_label = 0;
    std::size_t* last = nullptr;
    const int gk = static_cast<int>(k) + base[2];
    for (int j = 0; j < region.size[1]; ++j) {
      const int gj = j + base[1];
      const bool row_in = gj >= 0 && gj < labels.size[1] && gk >= 0 && gk < labels.size[2];
      std::size_t index = region.index(0, j, static_cast<int>(k));
      for (int i = 0; i < region.size[0]; ++i, ++index) {
        if (!wanted[index]) continue;
        const int gi = i + base[0];
        const std::int32_t label =
            row_in && gi >= 0 && gi < labels.size[0] ? labels.at(gi, gj, gk) : 0;
        if (label <= 0) {
          slab.unlabelled_inside += inside[index];
          continue;
        }
        if (!last || label != last_label) last = &slab.inside.try_emplace(label, 0).first->second;
        last_label = label;
        *last += inside[index];
        region.values[index] = label;
      }
    }
  });
  std::map<std::int32_t, std::size_t> counts;
  for (const Slab& slab : found) {
    lattice.filled_voxels += slab.unlabelled_inside;
    for (const auto& [label, count] : slab.inside) counts[label] += count;
  }
  if (counts.empty()) {
    throw InputError(
        "the label volume has no label (value above 0) inside the mesh: check its origin and "
        "spacing");
  }
  // Labels count that have a voxel inside; where the whole mesh is thinner than a voxel, all.
  const bool any_inside =
      std::any_of(counts.begin(), counts.end(), [](const auto& c) { return c.second > 0; });
  for (const auto& [label, count] : counts) {
    (count > 0 || !any_inside ? lattice.labels : lattice.labels_outside).push_back(label);
  }
  parallel_for(slabs, threads, [&](std::size_t k) {
    std::int32_t last_label = 0, last_region = 0;
    for (std::size_t index = region.index(0, 0, static_cast<int>(k)),
                     end = region.index(0, 0, static_cast<int>(k) + 1);
         index < end; ++index) {
      std::int32_t& value = region.values[index];
      if (value == 0) continue;
      if (value != last_label) {
        last_label = value;
        const auto at = std::lower_bound(lattice.labels.begin(), lattice.labels.end(), value);
        last_region = at != lattice.labels.end() && *at == value
                          ? static_cast<std::int32_t>(at - lattice.labels.begin()) + 1
                          : 0;
      }
      value = last_region;
    }
  });
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
  const double bytes = count * bytes_per_sample;
  if (const auto available = static_cast<double>(available_memory()); bytes > available) {
    throw InputError(
        fmt::format("the mesh covers {:.3g} voxels of the label volume; the partition takes "
                    "{:.1f} GB of memory, of which {:.1f} are available: use a coarser volume, or "
                    "a machine with more memory",
                    count, bytes / 1e9, available / 1e9));
  }
  LabelLattice lattice;
  lattice.region =
      VoxelGrid<std::int32_t>(size, labels.position(base[0], base[1], base[2]), labels.spacing);
  VoxelGrid<std::int32_t>& region = lattice.region;
  const std::vector<std::uint8_t> inside = inside_samples(mesh, region, threads);
  std::vector<std::uint8_t> wanted = samples_near_surface(mesh, region, threads);
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] |= inside[i];

  take_labels(labels, base, inside, wanted, threads, lattice);

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
