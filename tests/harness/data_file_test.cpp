#include "harness/data_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/random.h"
#include "harness/hdf5_handle.h"
#include "temporary_folder.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

DataTree sample_tree() {
  Random random(3);
  std::vector<double> points(3 * 20000);
  for (double& x : points) x = random.normal();
  DataTree tree;
  tree.put("fragments/vertices", points, 3);
  tree.put("fragments/faces", std::vector<std::int32_t>(3 * 5000, -7), 3);
  tree.put("fragments/starts", std::vector<std::uint64_t>{0, 5, UINT64_MAX});
  tree.put("notes", std::vector<std::string>{"", "größer", "x"});
  tree.put("nothing", std::vector<std::string>{});
  tree.put("no_numbers", std::vector<double>{}, 3);
  tree.put("status", std::string_view("ok"));
  tree.put("reason", std::string_view(""));
  tree.put("total", 0.25);
  tree.put("count", std::int64_t{-4});
  tree.put("seed", std::uint64_t{1} << 63);
  return tree;
}

class DataFileTest : public testing::Test {
 protected:
  fs::path write(const std::string& bytes) const {
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  TemporaryFolder temporary;
  fs::path folder = temporary.path();
  fs::path file = folder / "tree.h5";
};

TEST_F(DataFileTest, ATreeComesBackAsItWas) {
  const DataTree tree = sample_tree();
  const DataTree back = read_hdf5(write(to_hdf5(tree)));
  EXPECT_EQ(back, tree);
  EXPECT_EQ(back.digest(), tree.digest());
  EXPECT_EQ(back.texts("notes"), (std::vector<std::string>{"", "größer", "x"}));
  EXPECT_EQ(back.integer("count"), -4);
  EXPECT_EQ(back.text("status"), "ok");
  EXPECT_EQ(back.reals("fragments/vertices", 3).size(), 60000);
}

TEST_F(DataFileTest, TheSameTreeGivesTheSameFileBytes) {
  const std::string first = to_hdf5(sample_tree());
  to_hdf5(DataTree());
  EXPECT_TRUE(first == to_hdf5(sample_tree()));
}

TEST_F(DataFileTest, RepetitiveArraysAreCompressed) {
  DataTree tree;
  tree.put("zeros", std::vector<double>(100000));
  EXPECT_LT(to_hdf5(tree).size(), 20000);
}

TEST_F(DataFileTest, AFilterReadsOnlyPart) {
  const DataTree back = read_hdf5(write(to_hdf5(sample_tree())), [](std::string_view path) {
    return !path.starts_with("fragments/");
  });
  EXPECT_FALSE(back.has("fragments/vertices"));
  EXPECT_TRUE(back.has("status"));
}

TEST_F(DataFileTest, TheDigestSeesNamesTypesShapesAndBytes) {
  const auto digest = [](const auto& fill) {
    DataTree tree;
    fill(tree);
    return tree.digest();
  };
  const std::vector<double> values = {1, 2, 3, 4};
  const auto base = digest([&](DataTree& t) { t.put("a", values); });
  EXPECT_NE(base, digest([&](DataTree& t) { t.put("b", values); }));
  EXPECT_NE(base, digest([&](DataTree& t) { t.put("a", values, 2); }));
  EXPECT_NE(base, digest([&](DataTree& t) { t.put("a", std::vector<double>{1, 2, 3, 5}); }));
  EXPECT_NE(base, digest([&](DataTree& t) { t.put("a", std::vector<std::uint64_t>{1, 2, 3, 4}); }));
}

TEST_F(DataFileTest, GettersRefuseWhatIsMissingOrOfAnotherKind) {
  const DataTree tree = sample_tree();
  EXPECT_THROW(tree.real("missing"), DataError);
  EXPECT_THROW(tree.real("count"), DataError);
  EXPECT_THROW(tree.reals("total"), DataError);
  EXPECT_THROW(tree.reals("fragments/vertices", 2), DataError);
  EXPECT_THROW(tree.text("notes"), DataError);
}

TEST_F(DataFileTest, FilesCutShortAnywhereAreRefused) {
  const std::string bytes = to_hdf5(sample_tree());
  for (std::size_t k = 0; k < 60; ++k) {
    const std::size_t size = bytes.size() * k / 60;
    EXPECT_THROW(read_hdf5(write(bytes.substr(0, size))), DataError) << size;
  }
  EXPECT_THROW(read_hdf5(write(bytes.substr(0, bytes.size() - 1))), DataError);
  EXPECT_THROW(read_hdf5(folder / "none.h5"), DataError);
}

TEST_F(DataFileTest, ADamagedByteIsRefusedOrChangesTheDigest) {
  const DataTree tree = sample_tree();
  const std::string bytes = to_hdf5(tree);
  Random random(11);
  int unnoticed = 0;
  for (int k = 0; k < 150; ++k) {
    std::string damaged = bytes;
    damaged[random.below(bytes.size())] ^= static_cast<char>(1 + random.below(255));
    try {
      unnoticed += read_hdf5(write(damaged)) == tree;
    } catch (const DataError&) {
    }
  }
  // Bytes between objects mean nothing; there are few of them.
  EXPECT_LE(unnoticed, 15);
}

TEST_F(DataFileTest, AnArrayThatClaimsToBeHugeIsRefusedBeforeMemoryIsTaken) {
  {
    const Hdf5Handle out(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                         "file");
    const hsize_t extent = hsize_t{1} << 45;
    const hsize_t chunk = 1024;
    const Hdf5Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose, "space");
    const Hdf5Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "list");
    H5Pset_chunk(list, 1, &chunk);
    const Hdf5Handle data(
        H5Dcreate2(out, "huge", H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT), H5Dclose,
        "data");
  }
  EXPECT_THAT([&] { read_hdf5(file); },
              testing::ThrowsMessage<DataError>(testing::HasSubstr("far larger than its file")));
}

TEST_F(DataFileTest, LinksToOtherFilesAreRefused) {
  {
    const Hdf5Handle out(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                         "file");
    H5Lcreate_external("other.h5", "/status", out, "status", H5P_DEFAULT, H5P_DEFAULT);
  }
  EXPECT_THAT([&] { read_hdf5(file); },
              testing::ThrowsMessage<DataError>(testing::HasSubstr("link to elsewhere")));
}

}  // namespace
}  // namespace fracbench
