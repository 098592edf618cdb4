#include "geometry/write_vtk.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "core/error.h"
#include "tests/geometry/temporary_folder.h"
#include "tests/geometry/test_meshes.h"

namespace fracbench {
namespace {

using WriteVtk = TemporaryFolder;

/// The values of an array, found as a reader finds it: by its offset behind the mark "_".
template <typename T>
std::vector<T> array(const std::string& file, const std::string& name) {
  const auto element = file.find("Name=\"" + name + "\"");
  const auto offset = std::stoull(file.substr(file.find("offset=\"", element) + 8));
  const auto begin = file.find('_', file.find("<AppendedData")) + 1 + offset;
  std::uint64_t size = 0;
  std::memcpy(&size, file.data() + begin, sizeof size);
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), file.data() + begin + sizeof size, size);
  return values;
}

TEST_F(WriteVtk, WritesMeshesWithTheirValues) {
  const TriangleMesh cube = test_meshes::cube();
  VtkData data;
  data.on_vertices.push_back({"displacement", 3, std::vector<float>(24, 0.5F)});
  data.on_faces.push_back({"stress", 1, std::vector<float>(12, 7.0F)});
  write_vtp(folder_ / "cube.vtp", cube, data);
  const std::string file = content(folder_ / "cube.vtp");
  const auto points = array<double>(file, "Points");
  ASSERT_EQ(points.size(), 24u);
  EXPECT_EQ(points[4], cube.vertices[1].y());
  const auto corners = array<std::int32_t>(file, "connectivity");
  ASSERT_EQ(corners.size(), 36u);
  EXPECT_EQ(corners[5], cube.faces[1][2]);
  EXPECT_EQ(array<std::int32_t>(file, "offsets").back(), 36);
  EXPECT_EQ(array<float>(file, "displacement"), std::vector<float>(24, 0.5F));
  EXPECT_EQ(array<float>(file, "stress"), std::vector<float>(12, 7.0F));
  EXPECT_NE(file.find("</AppendedData>\n</VTKFile>"), std::string::npos);
}

TEST_F(WriteVtk, WritesLabelVolumes) {
  VoxelGrid<std::int32_t> grid({2, 3, 4}, Vec3(1, 2, 3), 0.5);
  grid.at(1, 2, 3) = 9;
  write_vti(folder_ / "labels.vti", grid);
  const std::string file = content(folder_ / "labels.vti");
  EXPECT_EQ(array<std::int32_t>(file, "label"), grid.values);
  EXPECT_NE(file.find("WholeExtent=\"0 1 0 2 0 3\" Origin=\"1 2 3\" Spacing=\"0.5 0.5 0.5\""),
            std::string::npos);
}

TEST_F(WriteVtk, RefusesArraysOfAnotherLengthAndFilesThatCannotBeWritten) {
  VtkData data;
  data.on_faces.push_back({"stress", 1, std::vector<float>(11)});
  EXPECT_THROW(write_vtp(folder_ / "a.vtp", test_meshes::cube(), data), std::logic_error);
  EXPECT_THROW(write_vtp(folder_ / "no" / "a.vtp", test_meshes::cube()), InputError);
}

}  // namespace
}  // namespace fracbench
