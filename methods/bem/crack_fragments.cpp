#include "methods/bem/crack_fragments.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "geometry/measures.h"
#include "methods/bem/isosurface_pieces.h"

namespace fracbench::bem {
namespace {

// Where cracks cross, a few links of one separate what the other has separated.
constexpr double kSeparatingShare = 0.2;

/// Gives the voxels of small parts to the neighbours with which they share the most cut links, the
/// smallest part first. Parts without a neighbour stay.
void merge_small(const CutLinks& links, double smallest, VoxelGrid<std::int32_t>& labels,
                 FragmentReport& report) {
  std::vector<double> size(1, 0);
  for (const std::int32_t l : labels.values) {
    if (l >= static_cast<std::int32_t>(size.size())) size.resize(l + 1, 0);
    size[l] += 1;
  }
  report.parts = size.size() - 1;
  std::set<std::pair<double, std::int32_t>> small;
  for (std::size_t l = 1; l < size.size(); ++l) {
    if (size[l] < smallest) small.emplace(size[l], static_cast<std::int32_t>(l));
  }
  if (small.empty()) return;
  // Shared links of the small parts only; both ways where both are small.
  std::vector<std::map<std::int32_t, std::size_t>> shared(size.size());
  links.for_each_cut([&](std::int32_t a, std::int32_t b, std::int32_t) {
    const std::int32_t la = labels.values[a], lb = labels.values[b];
    if (la == lb) return;
    if (size[la] < smallest) ++shared[la][lb];
    if (size[lb] < smallest) ++shared[lb][la];
  });
  std::vector<std::int32_t> target(size.size());
  for (std::size_t l = 0; l < target.size(); ++l) target[l] = static_cast<std::int32_t>(l);
  const auto root = [&](std::int32_t l) {
    while (target[l] != l) l = target[l];
    return l;
  };
  const double voxel = std::pow(labels.spacing, 3);
  while (!small.empty()) {
    const std::int32_t l = small.begin()->second;
    small.erase(small.begin());
    std::map<std::int32_t, std::size_t> neighbours;
    for (const auto& [other, count] : shared[l]) {
      if (const std::int32_t r = root(other); r != l) neighbours[r] += count;
    }
    if (neighbours.empty()) continue;
    const std::int32_t to =
        std::max_element(neighbours.begin(), neighbours.end(), [](const auto& a, const auto& b) {
          return a.second < b.second;
        })->first;
    ++report.merged_parts;
    report.merged_volume += size[l] * voxel;
    const bool was_small = small.erase({size[to], to}) > 0;
    target[l] = to;
    size[to] += size[l];
    for (const auto& [other, count] : neighbours) {
      if (other != to && was_small) shared[to][other] += count;
    }
    if (was_small && size[to] < smallest) small.emplace(size[to], to);
  }
  for (std::int32_t& l : labels.values) l = root(l);
}

void count_cracks(const CutLinks& links, const VoxelGrid<std::int32_t>& labels,
                  FragmentReport& report) {
  struct Links {
    std::size_t all = 0, separating = 0;
  };
  std::map<std::int32_t, Links> cracks;
  links.for_each_cut([&](std::int32_t a, std::int32_t b, std::int32_t crack) {
    Links& of_crack = cracks[crack];
    ++of_crack.all;
    of_crack.separating += labels.values[a] != labels.values[b];
  });
  for (const auto& [crack, of_crack] : cracks) {
    const bool separates = static_cast<double>(of_crack.separating) >=
                           kSeparatingShare * static_cast<double>(of_crack.all);
    ++(separates ? report.separating_cracks : report.cracks_within);
  }
}

Piece whole(const TriangleMesh& body) {
  Piece piece{.mesh = body, .faces = std::vector<PieceFace>(body.faces.size()), .next = nullptr};
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    piece.faces[f].parent_face = static_cast<std::int32_t>(f);
  }
  return piece;
}

}  // namespace

CrackFragments crack_fragments(const TriangleMesh& body, const CutLinks& links,
                               const FragmentOptions& options, const Context& context) {
  CrackFragments result;
  result.labels = links.components();
  const double voxels = volume(body) / std::pow(links.spacing(), 3);
  merge_small(links, std::max(options.smallest * voxels, options.smallest_voxels), result.labels,
              result.report);
  count_cracks(links, result.labels, result.report);
  context.stop_if_asked();
  const auto& values = result.labels.values;
  std::int32_t first = 0;
  const bool separated = std::any_of(values.begin(), values.end(), [&](std::int32_t l) {
    if (l != 0 && first == 0) first = l;
    return l != 0 && l != first;
  });
  if (!separated) {
    result.pieces.push_back(whole(body));
    result.label_of = {first};
  } else if (options.parity) {
    IsosurfacePieces pieces =
        isosurface_pieces(body, result.labels, options.hull_share, context.threads);
    result.pieces = std::move(pieces.pieces);
    result.label_of = std::move(pieces.label_of);
  } else {
    Partition partition = partition_by_labels(body, result.labels, {.threads = context.threads});
    result.pieces = std::move(partition.pieces);
    result.label_of = partition.report.piece_label;
    result.report.partition = std::move(partition.report);
  }
  return result;
}

}  // namespace fracbench::bem
