#include "geometry/partition/cell_points.h"

#include "core/parallel.h"

namespace fracbench::partition {
namespace {

// Points stay this far from the sides of their cell, in cells.
constexpr double cell_margin = 0.02;
constexpr int last_sweeps = 2;
constexpr std::size_t grain = 1024;

Vec3 kept_in_cell(const Vec3& place) {
  return place.cwiseMax(cell_margin).cwiseMin(1 - cell_margin);
}

class Smoothing {
 public:
  Smoothing(std::vector<CellPoint>& points, int threads)
      : points_(points), threads_(threads), next_(points.size()) {}

  void sweep_places() {
    for_each([&](std::size_t n) {
      const CellPoint& point = points_[n];
      next_[n] = point.place;
      if (!point.movable) return;
      next_[n] = kept_in_cell(mean(point, [&](std::int32_t other, int side) {
        Vec3 place = points_[other].place;
        place[side / 2] += side % 2 ? 1 : -1;
        return place;
      }));
    });
    for_each([&](std::size_t n) { points_[n].place = next_[n]; });
  }

  void sweep(std::vector<Vec3>& values) {
    for_each([&](std::size_t n) {
      const CellPoint& point = points_[n];
      next_[n] = values[n];
      if (!point.movable) return;
      next_[n] = mean(point, [&](std::int32_t other, int) { return values[other]; });
    });
    values.swap(next_);
  }

  template <typename Work>
  void for_each(const Work& work) const {
    parallel_for(points_.size(), threads_, work, grain);
  }

 private:
  template <typename Value>
  static Vec3 mean(const CellPoint& point, const Value& value) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (int side = 0; side < 6; ++side) {
      if (point.neighbours[side] < 0) continue;
      sum += value(point.neighbours[side], side);
      ++count;
    }
    return sum / count;
  }

  std::vector<CellPoint>& points_;
  int threads_;
  std::vector<Vec3> next_;
};

}  // namespace

void smooth_points(std::vector<CellPoint>& points, int steps, int threads) {
  if (steps <= 0) return;
  std::vector<Vec3> moved(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) moved[n] = points[n].place;
  Smoothing smoothing(points, threads);
  for (int step = 0; step < steps; ++step) smoothing.sweep_places();
  smoothing.for_each([&](std::size_t n) { moved[n] -= points[n].place; });
  for (int step = 0; step < 2 * steps; ++step) smoothing.sweep(moved);
  smoothing.for_each([&](std::size_t n) {
    if (points[n].movable) points[n].place = kept_in_cell(points[n].place + moved[n]);
  });
  for (int step = 0; step < last_sweeps; ++step) smoothing.sweep_places();
}

}  // namespace fracbench::partition
