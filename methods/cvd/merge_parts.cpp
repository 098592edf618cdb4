#include <algorithm>
#include <map>
#include <set>

#include "methods/cvd/pieces.h"

namespace fracbench::cvd {

std::vector<std::int32_t> merge_small_parts(const CellComplex& complex, const CellParts& parts,
                                            double minimum_volume) {
  const std::size_t count = parts.volumes.size();
  std::vector<std::map<std::int32_t, double>> shared(count);  // area with each neighbour, m^2
  for (std::size_t t = 0; t < complex.cracks.size(); ++t) {
    const auto& [front, back] = parts.of_cracks[t];
    const Face& f = complex.cracks[t].corners;
    const Vec3& a = complex.vertices[f[0]];
    const double area = (complex.vertices[f[1]] - a).cross(complex.vertices[f[2]] - a).norm() / 2;
    shared[front][back] += area;
    shared[back][front] += area;
  }

  std::vector<std::int32_t> group(count);
  std::vector<double> volumes = parts.volumes;
  std::set<std::pair<double, std::int32_t>> small;
  for (std::size_t p = 0; p < count; ++p) {
    group[p] = static_cast<std::int32_t>(p);
    if (volumes[p] < minimum_volume) small.emplace(volumes[p], group[p]);
  }
  while (!small.empty()) {
    const std::int32_t from = small.begin()->second;
    small.erase(small.begin());
    if (shared[from].empty()) continue;  // stands alone
    const std::int32_t to =
        std::ranges::max_element(shared[from], {}, [](const auto& x) { return x.second; })->first;
    small.erase({volumes[to], to});
    for (const auto& [other, area] : shared[from]) {
      shared[other].erase(from);
      if (other == to) continue;
      shared[to][other] += area;
      shared[other][to] += area;
    }
    shared[from].clear();
    volumes[to] += volumes[from];
    if (volumes[to] < minimum_volume) small.emplace(volumes[to], to);
    std::ranges::replace(group, from, to);
  }

  std::vector<std::int32_t> piece(count, -1), number(count, -1);
  std::int32_t pieces = 0;
  for (std::size_t p = 0; p < count; ++p) {
    if (number[group[p]] < 0) number[group[p]] = pieces++;
    piece[p] = number[group[p]];
  }
  return piece;
}

}  // namespace fracbench::cvd
