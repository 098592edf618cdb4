#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <optional>
#include <string>

#include "geometry/segmentation/watershed.h"
#include "source_folder.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

/// The values of a gzipped raw array.
template <typename T>
std::vector<T> read_golden(const fs::path& file, std::size_t count) {
  std::vector<T> values(count + 1);  // one more, to see that the file ends
  gzFile input = gzopen(file.c_str(), "rb");
  if (input == nullptr) return {};
  const int bytes = gzread(input, values.data(), static_cast<unsigned>(values.size() * sizeof(T)));
  gzclose(input);
  values.resize(bytes < 0 ? 0 : static_cast<std::size_t>(bytes) / sizeof(T));
  return values;
}

struct GoldenVolume {
  std::string name;
  int r;
};

void PrintTo(const GoldenVolume& volume, std::ostream* stream) {
  *stream << volume.name << "_r" << volume.r;
}

/// Volumes made of formulas stand beside this file, those made from a mesh outside the repository.
std::optional<fs::path> folder_of(const GoldenVolume& volume) {
  const std::string file = volume.name + "_r" + std::to_string(volume.r) + ".gssdf.f32.gz";
  const fs::path source = FRACBENCH_SOURCE_DIR;
  for (const fs::path& folder :
       {source / "tests/geometry/segmentation/golden", source / "../shared/golden"}) {
    if (fs::exists(folder / file)) return folder;
  }
  return std::nullopt;
}

class GoldenVolumes : public testing::TestWithParam<GoldenVolume> {};

TEST_P(GoldenVolumes, GiveTheSameMinimaAndLabelsVoxelForVoxel) {
  const auto& [name, r] = GetParam();
  const std::optional<fs::path> folder = folder_of(GetParam());
  if (!folder) GTEST_SKIP() << "volume " << name << " is not in ../shared/golden";
  const std::string stem = name + "_r" + std::to_string(r);
  VoxelGrid<float> field = unit_grid<float>(r);
  const std::size_t count = field.values.size();
  field.values = read_golden<float>(*folder / (stem + ".gssdf.f32.gz"), count);
  ASSERT_EQ(field.values.size(), count);

  FloodGrid grid = make_flood_grid(field, 0.03f, false);
  const ExtendedMinima minima = label_extended_minima(grid, 3);
  EXPECT_EQ(labels_of(grid, field).values,
            read_golden<std::int32_t>(*folder / (stem + ".markers.i32.gz"), count));
  flood_watershed(grid, minima);
  EXPECT_EQ(labels_of(grid, field).values,
            read_golden<std::int32_t>(*folder / (stem + ".labels.i32.gz"), count));
}

INSTANTIATE_TEST_SUITE_P(All, GoldenVolumes,
                         testing::Values(GoldenVolume{"a", 32}, GoldenVolume{"a", 48},
                                         GoldenVolume{"b", 32}, GoldenVolume{"b", 48},
                                         GoldenVolume{"c", 32}, GoldenVolume{"c", 48},
                                         GoldenVolume{"d", 32}, GoldenVolume{"d", 48}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace fracbench
