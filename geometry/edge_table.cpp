#include "geometry/edge_table.h"

#include <algorithm>
#include <tuple>

namespace fracbench {

EdgeTable::EdgeTable(const TriangleMesh& mesh) : begin_(mesh.vertices.size() + 1, 0) {
  // A counting sort by the smaller vertex, then a small sort per vertex: linear in practice.
  const auto for_each_side = [&](const auto& visit) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const std::int32_t from = mesh.faces[f][k];
        const std::int32_t to = mesh.faces[f][(k + 1) % 3];
        if (from != to) visit(std::min(from, to), std::max(from, to), f, k, from < to);
      }
    }
  };
  for_each_side([&](std::int32_t low, auto...) { ++begin_[low + 1]; });
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  sides_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for_each_side([&](std::int32_t low, std::int32_t high, std::size_t f, int k, bool forward) {
    sides_[next[low]++] = {high, static_cast<std::int32_t>(f), static_cast<std::int8_t>(k),
                           forward};
  });
  for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
    std::sort(sides_.begin() + begin_[v], sides_.begin() + begin_[v + 1],
              [](const Side& a, const Side& b) {
                return std::tie(a.high, a.face, a.k) < std::tie(b.high, b.face, b.k);
              });
  }
}

}  // namespace fracbench
