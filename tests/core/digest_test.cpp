#include "core/digest.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"

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

TEST(Digest, OfAFileIsThatOfItsBytes) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("digest-" + std::to_string(::getpid()));
  for (const std::size_t size : {0u, 8u, 262144u, 700001u}) {
    std::string bytes(size, 'x');
    for (std::size_t k = 0; k < size; ++k) bytes[k] = static_cast<char>(k * k >> 5);
    std::ofstream(file, std::ios::binary) << bytes;
    Digest of_file, of_bytes;
    of_file.add_file(file);
    of_bytes.add(std::string_view(bytes));
    EXPECT_EQ(of_file.hex(), of_bytes.hex()) << size;
  }
  std::filesystem::remove(file);
  EXPECT_THROW(Digest().add_file(file), InputError);
  EXPECT_THROW(Digest().add_file(file.parent_path()), InputError);  // a folder
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
