#include "synthetic.h"

#include <gtest/gtest.h>

#include "geometry/measures.h"

namespace fracbench::synthetic {
namespace {

TEST(Synthetic, pieces_fill_the_cube) {
  const std::vector<Vec3> normals{{1, 0.3, 0.2}, {-0.4, 1, 0.1}, {0, 0.2, 1}};
  for (const Fragments& fragments :
       {cut_all(box(), {0.4, 0.5, 0.55}, normals), corrugated_cube(5, 30)}) {
    double sum = 0;
    for (const Fragment& fragment : fragments) {
      EXPECT_GT(volume(fragment.mesh), 0);
      EXPECT_EQ(fragment.faces.size(), fragment.mesh.faces.size());
      Vec3 open = Vec3::Zero();  // area vectors of a closed surface add up to nothing
      for (std::size_t f = 0; f < fragment.mesh.faces.size(); ++f) {
        open += area_vector2(fragment.mesh, f);
      }
      EXPECT_LT(open.norm(), 1e-14);
      sum += volume(fragment.mesh);
    }
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

}  // namespace
}  // namespace fracbench::synthetic
