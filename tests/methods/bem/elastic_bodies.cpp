#include "tests/methods/bem/elastic_bodies.h"

#include <array>
#include <map>

namespace fracbench::bem {

TriangleMesh cube_surface(int cells) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::int32_t> numbers;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      const auto vertex = [&](int i, int j) {
        std::array<int, 3> key;
        key[axis] = upper ? cells : 0;
        key[(axis + 1) % 3] = i;
        key[(axis + 2) % 3] = j;
        const auto [entry, is_new] =
            numbers.try_emplace(key, static_cast<std::int32_t>(mesh.vertices.size()));
        if (is_new) mesh.vertices.push_back(Vec3(key[0], key[1], key[2]) / cells);
        return entry->second;
      };
      for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
          const std::int32_t a = vertex(i, j);
          const std::int32_t b = vertex(i + 1, j);
          const std::int32_t c = vertex(i + 1, j + 1);
          const std::int32_t d = vertex(i, j + 1);
          mesh.faces.push_back(upper ? Face{a, b, c} : Face{a, c, b});
          mesh.faces.push_back(upper ? Face{a, c, d} : Face{a, d, c});
        }
      }
    }
  }
  return mesh;
}

}  // namespace fracbench::bem
