#include "core/digest.h"

#include <gtest/gtest.h>

namespace fracbench {
namespace {

TEST(Digest, IsSha256OverTheValueAndItsLength) {
  // sha256(08 00.. 00 | "fracture") computed with sha256sum.
  Digest digest;
  digest.add(std::string_view("fracture"));
  EXPECT_EQ(digest.hex(), "798c246007c2d105b64ef769d530bb4618b3f6c3eeee5c55dfd790ad6ad01410");
}

TEST(Digest, OfPartsIsThatOfTheWhole) {
  const std::vector<std::string_view> parts{"fra", "", "cture"};
  Digest digest;
  digest.add(parts);
  EXPECT_EQ(digest.hex(), "798c246007c2d105b64ef769d530bb4618b3f6c3eeee5c55dfd790ad6ad01410");
}

TEST(Digest, ChangesWithEveryVertexAndFace) {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const auto of = [](const TriangleMesh& m) {
    Digest digest;
    digest.add(m);
    return digest.hex();
  };
  const std::string before = of(mesh);
  EXPECT_EQ(before, of(mesh));
  TriangleMesh moved = mesh;
  moved.vertices[2].y() = std::nextafter(1.0, 2.0);
  EXPECT_NE(before, of(moved));
  TriangleMesh turned = mesh;
  turned.faces[0] = {0, 2, 1};
  EXPECT_NE(before, of(turned));
}

}  // namespace
}  // namespace fracbench
