#include "methods/cvd/clip_triangle.h"

#include <algorithm>

namespace fracbench::cvd {

namespace {

// Cuts one triangle down to one cell, bisector by bisector.
class CellClip {
 public:
  CellClip(const VoronoiCells& cells, const Corners& corners, std::int32_t cell)
      : cells_(cells), where_{corners, cells.sites[cell]}, cell_(cell) {}

  ClippedTriangle clip() {
    for (const std::int32_t j : cells_.neighbours[cell_]) cut_by(j);
    return {cell_, lines_};
  }

 private:
  void cut_by(std::int32_t j) {
    Bisector bisector{j, {}};
    bool cuts = false;
    for (int c = 0; c < 3; ++c) {
      bisector.at[c] = bisector_value(where_.site, cells_.sites[j], where_.corners[c]);
      cuts |= bisector.at[c].sign() >= 0;
    }
    if (!cuts) return;

    const std::size_t size = lines_.size();
    std::vector<std::uint8_t> outside(size);
    std::size_t count = 0;
    for (std::size_t n = 0; n < size; ++n) {
      outside[n] = side(lines_[(n + size - 1) % size], lines_[n], bisector) > 0;
      count += outside[n];
    }
    if (count == 0) return;
    if (count == size) throw Degenerate("a cell vanishes on a face of the body");
    std::vector<std::int32_t> kept;
    int entries = 0;
    for (std::size_t n = 0; n < size; ++n) {
      const bool from = outside[n], to = outside[(n + 1) % size];
      if (!from || !to) kept.push_back(lines_[n]);
      if (!from && to) {
        kept.push_back(j);
        ++entries;
      }
    }
    if (entries != 1) throw Degenerate("a bisector meets a convex polygon more than twice");
    lines_ = std::move(kept);
    active_.push_back(bisector);
  }

  const Bisector& active(std::int32_t site) const {
    return *std::ranges::find(active_, site, &Bisector::site);
  }

  int side(std::int32_t p, std::int32_t q, const Bisector& j) const {
    const Vec3& p_j = cells_.sites[j.site];
    if (p < 0 && q < 0) return side_of_corner(where_, -1 - q, j, p_j);
    if (p < 0 || q < 0) {
      const Bisector& k = active(std::max(p, q));
      return side_on_edge(where_, -1 - std::min(p, q), k, cells_.sites[k.site], j, p_j);
    }
    const Bisector& k = active(p);
    const Bisector& l = active(q);
    return side_inside(where_, k, cells_.sites[p], l, cells_.sites[q], j, p_j);
  }

  const VoronoiCells& cells_;
  CellAndTriangle where_;
  std::int32_t cell_;
  std::vector<std::int32_t> lines_{-1, -2, -3};
  std::vector<Bisector> active_;
};

}  // namespace

std::vector<ClippedTriangle> clip_triangle(const VoronoiCells& cells, const Corners& corners,
                                           const std::array<std::int32_t, 3>& owners) {
  std::vector<std::int32_t> queue;
  const auto visit = [&](std::int32_t cell) {
    if (std::ranges::find(queue, cell) == queue.end()) queue.push_back(cell);
  };
  for (const std::int32_t owner : owners) visit(owner);
  std::vector<ClippedTriangle> parts;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    parts.push_back(CellClip(cells, corners, queue[next]).clip());
    for (const std::int32_t line : parts.back().lines) {
      if (line >= 0) visit(line);
    }
  }
  return parts;
}

}  // namespace fracbench::cvd
