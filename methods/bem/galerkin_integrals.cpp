#include "methods/bem/galerkin_integrals.h"

#include <algorithm>
#include <cmath>

#include "methods/bem/touching_pairs.h"

namespace fracbench::bem {
namespace {

// Distance of the centroids over the sum of the radii from which a rule is good enough: relative
// errors below 1e-5.
constexpr double kFarRatio = 8.0;     // 3 points
constexpr double kMiddleRatio = 2.2;  // 6 points
constexpr double kNearRatio = 1.2;    // 12 points; nearer: cut
// How often each triangle of a pair is halved at most. Pairs that touch without sharing a corner
// end here, with an error of about 2^-depth.
constexpr int kMostCuts = 11;

// Turns corners so that those shared come first, in the same order in both. Returns how many.
int bring_shared_first(const Corners& test, const Corners& trial, std::array<int, 3>& test_order,
                       std::array<int, 3>& trial_order) {
  int shared = 0;
  std::array<bool, 3> test_used = {};
  std::array<bool, 3> trial_used = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!trial_used[j] && !test_used[i] && test[i] == trial[j]) {
        test_order[shared] = i;
        trial_order[shared++] = j;
        test_used[i] = trial_used[j] = true;
      }
    }
  }
  int next_test = shared;
  int next_trial = shared;
  for (int i = 0; i < 3; ++i) {
    if (!test_used[i]) test_order[next_test++] = i;
    if (!trial_used[i]) trial_order[next_trial++] = i;
  }
  return shared;
}

Corners in_order(const Corners& corners, const std::array<int, 3>& order) {
  return {corners[order[0]], corners[order[1]], corners[order[2]]};
}

}  // namespace

PairIntegrator::PairIntegrator(bool double_layer) : double_layer_(double_layer) {
  queues_[0].points = 3;
  queues_[1].points = 6;
  queues_[2].points = 12;
}

std::array<PairIntegrator::Part, 2> PairIntegrator::halves(const Part& part) {
  int longest = 0;
  double length = 0;
  for (int k = 0; k < 3; ++k) {
    const double side = (part.corners[(k + 1) % 3] - part.corners[k]).squaredNorm();
    if (side > length) {
      length = side;
      longest = k;
    }
  }
  const int next = (longest + 1) % 3;
  std::array<Part, 2> parts = {part, part};
  for (int half = 0; half < 2; ++half) {
    Part& own = parts[half];
    const int moved = half == 0 ? next : longest;
    own.corners[moved] = (part.corners[longest] + part.corners[next]) / 2;
    for (int c = 0; c < 3; ++c) {
      own.shape[3 * moved + c] = (part.shape[3 * longest + c] + part.shape[3 * next + c]) / 2;
    }
    own.area = part.area / 2;
    own.depth = part.depth + 1;
    own.centroid = (own.corners[0] + own.corners[1] + own.corners[2]) / 3;
    double squared = 0;
    for (const Vec3& corner : own.corners) {
      squared = std::max(squared, (corner - own.centroid).squaredNorm());
    }
    own.radius = std::sqrt(squared);
  }
  return parts;
}

void PairIntegrator::add(const Part& test, const Part& trial, PairIntegrals& target) {
  const double distance = (test.centroid - trial.centroid).norm();
  const double ratio = distance / (test.radius + trial.radius);
  if (ratio < kNearRatio && std::min(test.depth, trial.depth) < kMostCuts) {
    const bool cut_test =
        trial.depth >= kMostCuts || (test.depth < kMostCuts && test.radius >= trial.radius);
    for (const Part& half : halves(cut_test ? test : trial)) {
      cut_test ? add(half, trial, target) : add(test, half, target);
    }
    return;
  }
  Queue& queue = queues_[ratio >= kFarRatio ? 0 : ratio >= kMiddleRatio ? 1 : 2];
  queue.batch.set(queue.filled, test.corners, trial.corners);
  queue.scales[queue.filled] = test.area * trial.area;
  queue.shapes[queue.filled] = trial.shape;
  queue.targets[queue.filled] = &target;
  if (++queue.filled == kPairLanes) flush(queue);
}

void PairIntegrator::flush(Queue& queue) {
  if (queue.filled == 0) return;
  // Lanes left over repeat the first pair.
  for (int lane = queue.filled; lane < kPairLanes; ++lane) {
    for (int c = 0; c < 9; ++c) {
      queue.batch.test[c][lane] = queue.batch.test[c][0];
      queue.batch.trial[c][lane] = queue.batch.trial[c][0];
    }
  }
  PairSums sums;
  const std::span<const TrianglePoint> rule = triangle_rule(queue.points);
  if (double_layer_) {
    sum_pairs_with_double_layer(queue.batch, rule, sums);
  } else {
    sum_pairs(queue.batch, rule, sums);
  }
  for (int lane = 0; lane < queue.filled; ++lane) {
    std::array<double, 9>& values = queue.targets[lane]->values;
    const double scale = queue.scales[lane];
    for (int k = 0; k < kPairComponents; ++k) values[k] += scale * sums.values[k][lane];
    if (!double_layer_) continue;
    for (int j = 0; j < 3; ++j) {
      for (int c = 0; c < 3; ++c) {
        values[6 + c] += scale * queue.shapes[lane][3 * j + c] * sums.values[6 + j][lane];
      }
    }
  }
  queue.filled = 0;
}

void PairIntegrator::flush_all() {
  for (Queue& queue : queues_) flush(queue);
}

void PairIntegrator::integrate(const BoundaryElements& test, std::size_t test_index,
                               const BoundaryElements& trial,
                               std::span<const std::int32_t> trial_indices,
                               std::span<PairIntegrals> results) {
  const Part test_part{.corners = test.corners(test_index),
                       .centroid = test.centroids[test_index],
                       .radius = test.radii[test_index],
                       .area = test.areas[test_index]};
  for (std::size_t k = 0; k < trial_indices.size(); ++k) {
    const std::int32_t index = trial_indices[k];
    PairIntegrals& result = results[k];
    result = {};
    const Part trial_part{.corners = trial.corners(index),
                          .centroid = trial.centroids[index],
                          .radius = trial.radii[index],
                          .area = trial.areas[index]};
    // Triangles that share a corner have centroids no farther apart than the sum of their radii.
    const double reach = 1.0001 * (test_part.radius + trial_part.radius);
    if ((test_part.centroid - trial_part.centroid).squaredNorm() <= reach * reach) {
      std::array<int, 3> test_order;
      std::array<int, 3> trial_order;
      const int shared =
          bring_shared_first(test_part.corners, trial_part.corners, test_order, trial_order);
      if (shared > 0) {
        const Corners first = in_order(test_part.corners, test_order);
        const Corners second = in_order(trial_part.corners, trial_order);
        const Vec3& normal = trial.normals[index];
        const PairIntegrals touching = shared == 3   ? coincident_pair(first)
                                       : shared == 2 ? edge_pair(first, second, normal)
                                                     : vertex_pair(first, second, normal);
        result = touching;
        for (int j = 0; j < 3; ++j) result.values[6 + trial_order[j]] = touching.values[6 + j];
        continue;
      }
    }
    add(test_part, trial_part, result);
  }
  flush_all();
}

PairIntegrals PairIntegrator::integrate(const Corners& test, const Corners& trial) {
  const auto elements = [](const Corners& corners) {
    return make_boundary_elements({{corners.begin(), corners.end()}, {{0, 1, 2}}});
  };
  PairIntegrals result;
  const std::int32_t first = 0;
  integrate(elements(test), 0, elements(trial), {&first, 1}, {&result, 1});
  return result;
}

}  // namespace fracbench::bem
