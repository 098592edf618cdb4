#include "core/array_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/digest.h"
#include "core/error.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

constexpr ArrayFileKind kPlain{.format = "test", .version = 3};
constexpr ArrayFileKind kPacked{.format = "test", .version = 3, .packed = true};

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class ArrayFileTest : public ::testing::TestWithParam<bool> {
 protected:
  ~ArrayFileTest() override { fs::remove(file_); }

  ArrayFileKind kind() const { return GetParam() ? kPacked : kPlain; }

  /// What reading says against these bytes; empty where it says nothing.
  std::string complaint(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary) << bytes;
    try {
      read_array_file(file_, kind());
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  ArrayFile example() const {
    ArrayFile arrays;
    arrays.reals["x/y"] = {1.5, -0.0, 1e300, std::nextafter(1.0, 2.0)};
    arrays.reals["none"] = {};
    for (int k = 0; k < 5000; ++k) arrays.floats["wave"].push_back(std::sin(0.001f * k));
    arrays.integers["n"] = {-7, 0, 1 << 30};
    arrays.texts["note"] = "two\nlines, \"quoted\"";
    return arrays;
  }

  const fs::path file_ = fs::temp_directory_path() / ("array-file-" + std::to_string(::getpid()));
};

INSTANTIATE_TEST_SUITE_P(PlainAndPacked, ArrayFileTest, ::testing::Bool());

TEST_P(ArrayFileTest, GivesBackWhatWasWrittenBitForBit) {
  write_array_file(file_, example(), kind());
  EXPECT_EQ(read_array_file(file_, kind()), example());
  const std::string first = bytes_of(file_);
  write_array_file(file_, example(), kind());
  EXPECT_EQ(bytes_of(file_), first);
}

TEST_P(ArrayFileTest, NoticesEveryChangedByteAndEveryCut) {
  write_array_file(file_, example(), kind());
  const std::string good = bytes_of(file_);
  for (std::size_t k = 0; k < good.size(); k += 1 + good.size() / 97) {
    std::string bad = good;
    bad[k] = static_cast<char>(bad[k] ^ 4);
    EXPECT_NE(complaint(bad), "") << "byte " << k;
    EXPECT_NE(complaint(good.substr(0, k)), "") << "cut at " << k;
  }
  EXPECT_NE(complaint(good + "x"), "");
}

TEST_P(ArrayFileTest, RefusesOtherKindsAndVersions) {
  write_array_file(file_, example(), {.format = "other", .version = 3});
  EXPECT_THROW(read_array_file(file_, kind()), InputError);
  write_array_file(file_, example(), {.format = "test", .version = 4});
  EXPECT_THROW(read_array_file(file_, kind()), InputError);
}

// With a check sum that fits, so that the sizes themselves have to be looked at.
TEST_P(ArrayFileTest, TakesNoMemoryForSizesThatAreLies) {
  const auto file_of = [](const std::string& entry) {
    const std::string text =
        R"({"format":"test","version":3,"texts":{},"arrays":[)" + entry + "]}\nabcdefgh";
    Digest digest;
    digest.add(std::string_view(text));
    return text + digest.hex();
  };
  for (const char* entry :
       {R"(["a","float64",2])", R"(["a","float32",4611686018427387905])",
        R"(["a","int32",18446744073709551615])", R"(["a","float64",1000000000000,8])",
        R"(["a","float64",1,9])", R"(["a","text",1])", R"(["a","float64",-1])", R"(["a"])"}) {
    EXPECT_NE(complaint(file_of(entry)), "") << entry;
  }
  EXPECT_EQ(complaint(file_of(R"(["a","float64",1])")), "");
}

}  // namespace
}  // namespace fracbench
