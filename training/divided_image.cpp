#include "training/divided_image.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace fracbench::training {

namespace {

using neural::Representation;

// Distances are learned in units of this many pixels, and truncated there.
constexpr int kUnit = 16;
// From where on a pixel belongs to a line.
constexpr float kLine = 0.5f;
// How much higher than the pass between them both of two summits of a distance have to be, to be
// two regions.
constexpr float kDepth = 1.0f / kUnit;

template <typename Visit>
void for_neighbours(int pixel, int side, const Visit& visit) {
  const int x = pixel % side, y = pixel / side;
  if (x > 0) visit(pixel - 1);
  if (x + 1 < side) visit(pixel + 1);
  if (y > 0) visit(pixel - side);
  if (y + 1 < side) visit(pixel + side);
}

/// From each pixel to the nearest of the border, kUnit * kUnit at most.
std::vector<int> squared_distances(const std::vector<int>& border, int side) {
  std::vector<int> squares(static_cast<std::size_t>(side) * side, kUnit * kUnit);
  for (const int q : border) {
    const int at_x = q % side, at_y = q / side;
    for (int y = std::max(0, at_y - kUnit); y <= std::min(side - 1, at_y + kUnit); ++y) {
      for (int x = std::max(0, at_x - kUnit); x <= std::min(side - 1, at_x + kUnit); ++x) {
        int& least = squares[y * side + x];
        least = std::min(least, (x - at_x) * (x - at_x) + (y - at_y) * (y - at_y));
      }
    }
  }
  return squares;
}

/// Gives pixels without a region (-1) that of the nearest one that has.
Labels filled(Labels labels, int side) {
  std::deque<int> queue;
  for (int p = 0; p < static_cast<int>(labels.size()); ++p) {
    if (labels[p] >= 0) queue.push_back(p);
  }
  while (!queue.empty()) {
    const int p = queue.front();
    queue.pop_front();
    for_neighbours(p, side, [&](int q) {
      if (labels[q] >= 0) return;
      labels[q] = labels[p];
      queue.push_back(q);
    });
  }
  return labels;
}

/// The basins of a distance, as caged-SDF segmentation finds them in 3D: pixels from the highest
/// down join the region that they touch; where two regions meet, they become one if either rises
/// less than kDepth above the meeting place.
Labels basins_of(const std::vector<float>& image, int side) {
  std::vector<int> order(image.size()), parent(image.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](int p) { return image[p]; });
  const auto root = [&](int p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  std::vector<int> summit(image.size());
  for (const int p : order) {
    if (image[p] < kDepth / 2) break;  // borders: flat, to be filled from both sides
    parent[p] = p;
    summit[p] = p;
    for_neighbours(p, side, [&](int q) {
      if (parent[q] < 0) return;
      const int a = root(p), b = root(q);
      if (a == b) return;
      const int lower = image[summit[a]] < image[summit[b]] ? a : b, higher = lower == a ? b : a;
      // The pixel itself, while it has no region yet, always joins.
      if (summit[lower] != p && image[summit[lower]] - image[p] >= kDepth) return;
      parent[lower] = higher;
    });
  }
  Labels labels;
  for (int p = 0; p < static_cast<int>(image.size()); ++p) {
    labels.push_back(parent[p] < 0 ? -1 : root(p));
  }
  return filled(std::move(labels), side);
}

}  // namespace

Labels voronoi(const neural::StudySettings& s, Random& random) {
  const int count =
      s.least_sites +
      static_cast<int>(random.below(static_cast<std::uint64_t>(s.most_sites - s.least_sites + 1)));
  std::vector<std::pair<double, double>> sites;
  for (int n = 0; n < count; ++n) {
    const double x = random.uniform(0, s.side), y = random.uniform(0, s.side);
    sites.emplace_back(x, y);
  }
  Labels labels;
  for (int y = 0; y < s.side; ++y) {
    for (int x = 0; x < s.side; ++x) {
      const auto square = [&](const auto& site) {
        return std::pow(site.first - x, 2) + std::pow(site.second - y, 2);
      };
      labels.push_back(
          static_cast<std::int32_t>(std::ranges::min_element(sites, {}, square) - sites.begin()));
    }
  }
  return labels;
}

std::vector<float> image_of(const Labels& labels, Representation representation, int side) {
  const auto count = static_cast<float>(1 + *std::ranges::max_element(labels));
  std::vector<float> image(labels.size());
  std::vector<int> border;
  for (int p = 0; p < static_cast<int>(labels.size()); ++p) {
    bool at_border = false;
    for_neighbours(p, side, [&](int q) { at_border |= labels[q] != labels[p]; });
    if (at_border) border.push_back(p);
    image[p] = representation == Representation::labels ? (labels[p] + 1.0f) / count
                                                        : (at_border ? 1.0f : 0.0f);
  }
  if (representation != Representation::distance) return image;
  const std::vector<int> squares = squared_distances(border, side);
  for (std::size_t p = 0; p < image.size(); ++p) {
    image[p] = static_cast<float>(std::sqrt(squares[p]) / kUnit);
  }
  return image;
}

Labels regions_of(const std::vector<float>& image, Representation representation, int side,
                  int count) {
  Labels labels(image.size(), -1);
  if (representation == Representation::labels) {
    for (std::size_t p = 0; p < image.size(); ++p) {
      labels[p] = static_cast<std::int32_t>(std::lround(image[p] * static_cast<float>(count)));
    }
    return labels;
  }
  if (representation == Representation::distance) return basins_of(image, side);
  const auto inside = [&](int p) { return image[p] < kLine; };
  std::deque<int> queue;
  std::int32_t next = 0;
  for (int seed = 0; seed < static_cast<int>(image.size()); ++seed) {
    if (labels[seed] >= 0 || !inside(seed)) continue;
    labels[seed] = next;
    queue.push_back(seed);
    while (!queue.empty()) {
      const int p = queue.front();
      queue.pop_front();
      for_neighbours(p, side, [&](int q) {
        if (labels[q] >= 0 || !inside(q)) return;
        labels[q] = next;
        queue.push_back(q);
      });
    }
    ++next;
  }
  return filled(std::move(labels), side);
}

Labels in_order(const Labels& labels) {
  std::map<std::int32_t, std::int32_t> names;
  Labels renamed;
  for (const std::int32_t label : labels) {
    renamed.push_back(
        names.try_emplace(label, static_cast<std::int32_t>(names.size())).first->second);
  }
  return renamed;
}

double count_of(const Labels& labels) {
  return static_cast<double>(std::set(labels.begin(), labels.end()).size());
}

}  // namespace fracbench::training
