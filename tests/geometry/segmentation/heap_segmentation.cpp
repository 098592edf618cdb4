#include "heap_segmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <set>
#include <tuple>

namespace fracbench::reference {
namespace {

class Volume {
 public:
  Volume(const VoxelGrid<float>& field, std::vector<char> exists)
      : size_(field.size), exists_(std::move(exists)) {}

  bool exists(int v) const { return exists_[v] != 0; }
  int count() const { return static_cast<int>(exists_.size()); }
  std::array<int, 3> size() const { return size_; }

  std::vector<int> neighbours(int v) const {
    const int i = v % size_[0], j = v / size_[0] % size_[1], k = v / (size_[0] * size_[1]);
    std::vector<int> found;
    const auto add = [&](int a, int b, int c) {
      if (a < 0 || b < 0 || c < 0 || a >= size_[0] || b >= size_[1] || c >= size_[2]) return;
      const int to = a + size_[0] * (b + size_[1] * c);
      if (exists(to)) found.push_back(to);
    };
    add(i, j, k - 1);
    add(i - 1, j, k);
    add(i, j - 1, k);
    add(i, j + 1, k);
    add(i + 1, j, k);
    add(i, j, k + 1);
    return found;
  }

 private:
  std::array<int, 3> size_;
  std::vector<char> exists_;
};

using Relief = std::vector<float>;

/// The marker, lowered as far as its neighbours and the mask allow.
Relief reconstruct_by_erosion(const Volume& volume, Relief marker, const Relief& mask) {
  using Item = std::pair<float, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (int v = 0; v < volume.count(); ++v) {
    if (!volume.exists(v)) continue;
    marker[v] = std::max(marker[v], mask[v]);
    queue.emplace(marker[v], v);
  }
  while (!queue.empty()) {
    const auto [value, v] = queue.top();
    queue.pop();
    if (value > marker[v]) continue;
    for (const int to : volume.neighbours(v)) {
      const float lowered = std::max(value, mask[to]);
      if (lowered >= marker[to]) continue;
      marker[to] = lowered;
      queue.emplace(lowered, to);
    }
  }
  return marker;
}

/// Connected parts of equal value without a lower neighbour, numbered in the order of the voxels.
std::vector<std::int32_t> regional_minima(const Volume& volume, const Relief& relief) {
  std::vector<std::int32_t> label(volume.count(), 0);
  std::vector<char> done(volume.count(), 0);
  std::int32_t next = 0;
  for (int start = 0; start < volume.count(); ++start) {
    if (!volume.exists(start) || done[start]) continue;
    std::vector<int> plateau{start};
    done[start] = 1;
    bool is_minimum = true;
    for (std::size_t i = 0; i < plateau.size(); ++i) {
      for (const int to : volume.neighbours(plateau[i])) {
        if (relief[to] < relief[start]) is_minimum = false;
        if (relief[to] != relief[start] || done[to]) continue;
        done[to] = 1;
        plateau.push_back(to);
      }
    }
    if (!is_minimum) continue;
    ++next;
    for (const int v : plateau) label[v] = next;
  }
  return label;
}

std::vector<std::int32_t> watershed(const Volume& volume, const Relief& imposed,
                                    const std::vector<std::int32_t>& markers) {
  std::vector<std::int32_t> label = markers;
  std::vector<char> was_queued(volume.count(), 0);
  using Item = std::tuple<float, long, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  long order = 0;
  const auto push_neighbours = [&](int v) {
    for (const int to : volume.neighbours(v)) {
      if (label[to] != 0 || was_queued[to]) continue;
      was_queued[to] = 1;
      queue.emplace(imposed[to], order++, to);
    }
  };
  const auto [nx, ny, nz] = volume.size();
  for (int k = 0; k < nz; ++k) {
    for (int i = 0; i < nx; ++i) {
      for (int j = 0; j < ny; ++j) {
        const int v = i + nx * (j + ny * k);
        if (markers[v] != 0) push_neighbours(v);
      }
    }
  }
  while (!queue.empty()) {
    const int v = std::get<2>(queue.top());
    queue.pop();
    std::set<std::int32_t> beside;
    for (const int to : volume.neighbours(v)) {
      if (label[to] > 0) beside.insert(label[to]);
    }
    if (beside.size() != 1) continue;
    label[v] = *beside.begin();
    push_neighbours(v);
  }
  return label;
}

}  // namespace

HeapSegmentation heap_segmentation(const VoxelGrid<float>& field, float cage, float h,
                                   bool inside_only) {
  const std::size_t count = field.values.size();
  std::vector<char> exists(count, 1);
  Relief relief(count);
  for (std::size_t v = 0; v < count; ++v) {
    const float g = field.values[v] + cage;
    if (inside_only && g < 0) exists[v] = 0;
    relief[v] = 255.0f - (std::abs(g) + 1.0f) / 2.0f * 255.0f;
  }
  const Volume volume(field, exists);

  Relief raised = relief;
  for (float& value : raised) value += h;
  const std::vector<std::int32_t> markers =
      regional_minima(volume, reconstruct_by_erosion(volume, raised, relief));

  Relief marker(count, 255.0f), mask = relief;
  for (std::size_t v = 0; v < count; ++v) {
    mask[v] = markers[v] != 0 ? 0 : relief[v] + 1.0f;
    if (markers[v] != 0) marker[v] = 0;
  }
  const std::vector<std::int32_t> labels =
      watershed(volume, reconstruct_by_erosion(volume, marker, mask), markers);

  HeapSegmentation result;
  result.markers = VoxelGrid<std::int32_t>(field.size, field.origin, field.spacing);
  result.labels = result.markers;
  result.markers.values = markers;
  result.labels.values = labels;
  return result;
}

}  // namespace fracbench::reference
