#include "geometry/equal_vertices.h"

#include <bit>

namespace fracbench {

namespace {

/// The finaliser of MurmurHash3: every bit of the input moves every bit of the result.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdULL;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

std::uint64_t hash(const Vec3& v) {
  std::uint64_t h = 0;
  // Adding 0 turns -0 into 0.
  for (int i = 0; i < 3; ++i) h = mixed(h ^ std::bit_cast<std::uint64_t>(v[i] + 0.0)) + i;
  return h;
}

}  // namespace

std::vector<std::int32_t> first_equal_vertex(const std::vector<Vec3>& vertices) {
  std::vector<std::int32_t> first(vertices.size());
  // Open addressing, at most half full.
  const std::size_t mask = std::bit_ceil(2 * vertices.size() + 1) - 1;
  std::vector<std::int32_t> table(mask + 1, -1);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    std::size_t slot = hash(vertices[v]) & mask;
    while (table[slot] >= 0 && vertices[table[slot]] != vertices[v]) slot = (slot + 1) & mask;
    if (table[slot] < 0) table[slot] = static_cast<std::int32_t>(v);
    first[v] = table[slot];
  }
  return first;
}

}  // namespace fracbench
