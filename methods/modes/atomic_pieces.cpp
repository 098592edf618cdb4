#include "methods/modes/atomic_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "methods/modes/join.h"

namespace fracbench::modes {
namespace {

/// Merges cells step by step. A group has the number of the lowest cell in it.
class CellMerger {
 public:
  CellMerger(const CutBody& cut, const Eigen::MatrixXd& motion)
      : shared_(cut.cells.size()), sets_(std::ssize(cut.cells)), count_(cut.cells.size()) {
    for (const CutBody::Cell& cell : cut.cells) {
      volume_.push_back(cell.volume);
      motion_.emplace_back(motion.rows() > 0 ? motion.col(cell.region) : Eigen::VectorXd());
    }
    for (const auto& part : cut.interfaces) {
      const auto [a, b] = part.cells;
      if (a == b) continue;
      const Vec3& o = cut.vertices[part.corners[0]];
      const double area2 =
          (cut.vertices[part.corners[1]] - o).cross(cut.vertices[part.corners[2]] - o).norm();
      shared_[a][b] += area2;
      shared_[b][a] += area2;
    }
  }

  void merge_below(double minimum_volume) {
    std::set<std::pair<double, std::int32_t>> small;
    const auto add = [&](std::int32_t c) {
      if (volume_[c] < minimum_volume) small.emplace(volume_[c], c);
    };
    for (std::size_t c = 0; c < volume_.size(); ++c) add(static_cast<std::int32_t>(c));
    while (!small.empty()) {
      const std::int32_t c = small.begin()->second;
      small.erase(small.begin());
      if (shared_[c].empty()) continue;
      const std::int32_t to = std::ranges::max_element(shared_[c], {}, [](const auto& entry) {
                                return entry.second;
                              })->first;
      small.erase({volume_[to], to});
      add(join(c, to));
    }
  }

  void merge_to(std::size_t wanted) {
    while (count_ > wanted) {
      std::pair<std::int32_t, std::int32_t> cheapest{-1, -1};
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t a = 0; a < shared_.size(); ++a) {
        for (const auto& [b, area2] : shared_[a]) {
          if (b < static_cast<std::int32_t>(a)) continue;
          const double cost = merge_cost(static_cast<std::int32_t>(a), b);
          if (cost >= least) continue;
          least = cost;
          cheapest = {static_cast<std::int32_t>(a), b};
        }
      }
      if (cheapest.first < 0) return;
      join(cheapest.first, cheapest.second);
    }
  }

  std::vector<std::int32_t> groups() { return sets_.labels(); }

 private:
  double merge_cost(std::int32_t a, std::int32_t b) const {
    return volume_[a] * volume_[b] / (volume_[a] + volume_[b]) *
           (motion_[a] - motion_[b]).squaredNorm();
  }

  std::int32_t join(std::int32_t a, std::int32_t b) {
    sets_.join(a, b);
    const std::int32_t to = std::min(a, b), from = std::max(a, b);
    const double sum = volume_[to] + volume_[from];
    motion_[to] = (volume_[to] * motion_[to] + volume_[from] * motion_[from]) / sum;
    volume_[to] = sum;
    for (const auto& [other, area2] : shared_[from]) {
      shared_[other].erase(from);
      if (other == to) continue;
      shared_[other][to] += area2;
      shared_[to][other] += area2;
    }
    shared_[from].clear();
    --count_;
    return to;
  }

  std::vector<double> volume_;
  std::vector<Eigen::VectorXd> motion_;
  std::vector<std::map<std::int32_t, double>> shared_;  ///< twice the area with each neighbour
  Joined sets_;
  std::size_t count_;
};

/// Regions whose cells all go to one group take a number in common.
std::vector<std::int32_t> joined_regions(const CutBody& cut, std::span<const std::int32_t> group,
                                         std::span<const std::int32_t> region_of_tet) {
  const std::int32_t regions = 1 + *std::ranges::max_element(region_of_tet);
  constexpr std::int32_t none = -1, several = -2;
  std::vector<std::int32_t> only(regions, none);
  for (std::size_t c = 0; c < group.size(); ++c) {
    std::int32_t& g = only[cut.cells[c].region];
    g = g == none || g == group[c] ? group[c] : several;
  }
  std::map<std::pair<bool, std::int32_t>, std::int32_t> number;
  std::vector<std::int32_t> result;
  for (const std::int32_t r : region_of_tet) {
    const std::pair key = only[r] >= 0 ? std::pair(true, only[r]) : std::pair(false, r);
    result.push_back(
        number.try_emplace(key, static_cast<std::int32_t>(number.size())).first->second);
  }
  return result;
}

}  // namespace

std::vector<std::int32_t> common_pieces(const TetMesh& tets,
                                        std::span<const std::vector<std::int32_t>> pieces_by_mode) {
  Joined sets(std::ssize(tets.tets));
  for (const auto& face : tets.interior_faces) {
    const std::int32_t a = face.tets[0], b = face.tets[1];
    if (std::ranges::all_of(pieces_by_mode,
                            [&](const auto& pieces) { return pieces[a] == pieces[b]; })) {
      sets.join(a, b);
    }
  }
  return sets.labels();
}

Eigen::MatrixXd mode_motion(const TetMesh& tets, const FractureModes& modes,
                            std::span<const std::int32_t> region_of_tet) {
  const std::int32_t regions = 1 + *std::ranges::max_element(region_of_tet);
  const Eigen::Index d = modes.dimension, count = modes.displacement.cols();
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(d * count, regions);
  std::vector<double> volume(regions, 0);
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    volume[region_of_tet[t]] += tets.volumes[t];
    for (Eigen::Index k = 0; k < count; ++k) {
      motion.col(region_of_tet[t]).segment(d * k, d) +=
          tets.volumes[t] * modes.displacement.col(k).segment(d * static_cast<Eigen::Index>(t), d);
    }
  }
  for (std::int32_t r = 0; r < regions; ++r) {
    if (volume[r] > 0) motion.col(r) /= volume[r];
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    const double energy = modes.energies[k];
    const double weight = energy > 0 ? std::sqrt(modes.energies[0] / energy) : 1;
    motion.middleRows(d * k, d) *= weight;
  }
  return motion;
}

std::vector<std::int32_t> merge_cells(const CutBody& cut, const Eigen::MatrixXd& motion,
                                      const MergeOptions& options) {
  CellMerger merger(cut, motion);
  merger.merge_below(options.minimum_volume);
  if (options.wanted > 0) merger.merge_to(static_cast<std::size_t>(options.wanted));
  return merger.groups();
}

AtomicPieces atomic_pieces(const TriangleMesh& body, const TetMesh& tets,
                           const FractureModes& modes, const MergeOptions& options,
                           Context& context) {
  AtomicPieces result;
  result.region_of_tet = common_pieces(tets, modes.pieces);
  CutBody cut;
  std::vector<std::int32_t> group;
  for (int pass = 0; pass < 2; ++pass) {
    cut = cut_body(body, tets, result.region_of_tet, context);
    group = merge_cells(cut, mode_motion(tets, modes, result.region_of_tet), options);
    if (pass > 0) break;
    std::vector<std::int32_t> joined = joined_regions(cut, group, result.region_of_tet);
    if (joined == result.region_of_tet) break;
    result.region_of_tet = std::move(joined);
  }
  result.cut = join_cells(cut, group);
  std::vector<std::map<std::int32_t, double>> volumes(result.cut.cells.size());
  for (std::size_t c = 0; c < group.size(); ++c) {
    volumes[group[c]][cut.cells[c].region] += cut.cells[c].volume;
  }
  for (const auto& of_piece : volumes) {
    auto& shares = result.regions.emplace_back();
    for (const auto& [region, volume] : of_piece) shares.push_back({region, volume});
  }
  return result;
}

}  // namespace fracbench::modes
