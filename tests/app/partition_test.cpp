#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.h"

namespace fracbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A cube of side 2 whose lower corner is at (10, 0, 0).
constexpr const char* kCube =
    "v 10 0 0\nv 12 0 0\nv 10 2 0\nv 12 2 0\nv 10 0 2\nv 12 0 2\nv 10 2 2\nv 12 2 2\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

/// 6 x 6 x 6 voxels of side 0.5 from x = `x0` on, label 1 in the lower half along z, 2 above.
std::string volume_at(double x0) {
  std::string text =
      "NRRD0004\ntype: int32\ndimension: 3\nsizes: 6 6 6\nencoding: ascii\nspace dimension: 3\n"
      "space origin: (" +
      std::to_string(x0 + 0.25) +
      ",-0.25,-0.25)\nspace directions: (0.5,0,0) (0,0.5,0) (0,0,0.5)\n\n";
  for (int k = 0; k < 216; ++k) text += k < 108 ? "1 " : "2 ";
  return text;
}

TEST(PartitionCommand, CutsAMeshInTwoHalvesWhereTheLabelsMeet) {
  const TemporaryFolder folder;
  folder.write("cube.obj", kCube);
  folder.write("labels.nrrd", volume_at(9.5));
  for (const char* path : {"fast", "exact"}) {
    const Answer answer =
        call(std::string("partition cube.obj labels.nrrd --out out --json --path ") + path,
             folder.path());
    ASSERT_EQ(answer.exit_code, 0) << answer.errors;
    const auto result = answer.json();
    EXPECT_EQ(result["status"], "ok");
    EXPECT_NEAR(result["volume_ratio"].get<double>(), 1, 1e-9);
    EXPECT_NEAR(result["surface_retention"].get<double>(), 1, 1e-9);
    ASSERT_EQ(result["fragment_count"], 2);
    EXPECT_NEAR(result["volumes"][0].get<double>(), 5, 1e-6);
    EXPECT_EQ(result["partition"]["piece_label"], nlohmann::json({1, 2}));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/fragment_001.obj"));
  }
}

TEST(PartitionCommand, RefusesAVolumeInAnotherPlaceAndNamesBothFiles) {
  const TemporaryFolder folder;
  folder.write("cube.obj", kCube);
  folder.write("labels.nrrd", volume_at(-1));
  const Answer answer = call("partition cube.obj labels.nrrd --out out", folder.path());
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.errors, AllOf(HasSubstr("cube.obj"), HasSubstr("labels.nrrd"),
                                   HasSubstr("origin and spacing")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST(PartitionCommand, RefusesAMinimumThatIsNoNumber) {
  const TemporaryFolder folder;
  folder.write("cube.obj", kCube);
  folder.write("labels.nrrd", volume_at(0));
  const Answer answer =
      call("partition cube.obj labels.nrrd --out out --minimum-voxels nan", folder.path());
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.errors, HasSubstr("--minimum-voxels"));
}

}  // namespace
}  // namespace fracbench
