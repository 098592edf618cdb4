#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "core/random.h"
#include "geometry/read_label_volume.h"
#include "volume_files.h"

namespace fracbench {
namespace {

using testing::HasSubstr;

const std::vector<std::int32_t> some_labels = {0, 1, 2,  3,   -1, 5,  6, 7, 8, 9, 10, 11,
                                               4, 3, 17, 100, 0,  -7, 1, 1, 1, 2, 2,  0};

const std::string place =
    "space dimension: 3\nspace origin: (-1,-0.5,0.25)\n"
    "space directions: (0.125,0,0) (0,0.125,0) (0,0,0.125)\n";

std::string header(const std::string& type, const std::string& encoding,
                   const std::string& more = place) {
  return "NRRD0004\n# a comment\ntype: " + type +
         "\ndimension: 3\nsizes: 4 3 2\nencoding: " + encoding +
         "\nendian: little\nsomebody:=something else\n" + more + "\n";
}

VoxelGrid<std::int32_t> read(const std::string& bytes) {
  const test::ScratchFile file(".nrrd");
  file.write(bytes);
  return read_label_volume(file.path());
}

std::string message_of(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

/// With one piece of a good header replaced.
std::string message_with(const std::string& before, const std::string& after) {
  std::string text = header("int32", "raw");
  const std::size_t at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  text.replace(at, before.size(), after);
  return message_of(text + test::raw_bytes<std::int32_t>(some_labels));
}

void expect_some_labels(const VoxelGrid<std::int32_t>& labels,
                        const std::vector<std::int32_t>& values = some_labels) {
  EXPECT_EQ(labels.size, (std::array<std::int32_t, 3>{4, 3, 2}));
  EXPECT_EQ(labels.values, values);
  EXPECT_EQ(labels.spacing, 0.125);
  EXPECT_EQ(labels.origin, Vec3(-1, -0.5, 0.25));
}

TEST(Nrrd, EveryIntegerTypeAndByteOrderIsRead) {
  expect_some_labels(read(header("int8", "raw") + test::raw_bytes<std::int8_t>(some_labels)));
  expect_some_labels(read(header("short", "raw") + test::raw_bytes<std::int16_t>(some_labels)));
  expect_some_labels(read(header("int", "raw") + test::raw_bytes<std::int32_t>(some_labels)));
  expect_some_labels(read(header("long long", "raw") + test::raw_bytes<std::int64_t>(some_labels)));

  std::vector<std::int32_t> positive = some_labels;
  for (std::int32_t& label : positive) label += 130;
  const auto read_as = [](const std::string& type, const std::string& bytes) {
    return read(header(type, "raw") + bytes);
  };
  expect_some_labels(read_as("uchar", test::raw_bytes<std::uint8_t>(positive)), positive);
  expect_some_labels(read_as("uint16", test::raw_bytes<std::uint16_t>(positive)), positive);
  expect_some_labels(read_as("unsigned int", test::raw_bytes<std::uint32_t>(positive)), positive);
  expect_some_labels(read_as("uint64_t", test::raw_bytes<std::uint64_t>(positive)), positive);

  std::string big = header("int16", "raw");
  big.replace(big.find("little"), 6, "big");
  expect_some_labels(read(big + test::raw_bytes<std::int16_t>(some_labels, true)));
}

TEST(Nrrd, EveryEncodingIsRead) {
  const std::string raw = test::raw_bytes<std::int32_t>(some_labels);
  expect_some_labels(read(header("int32", "gzip") + test::gzipped(raw)));
  std::string text;
  for (const std::int32_t label : some_labels) text += std::to_string(label) + "\n ";
  expect_some_labels(read(header("int32", "ascii") + text));
}

TEST(Nrrd, LinesMayEndInTheDosWay) {
  std::string text = header("int32", "raw"), dos;
  for (const char c : text) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expect_some_labels(read(dos + test::raw_bytes<std::int32_t>(some_labels)));
}

TEST(Nrrd, AxisMinsAreTheEdgesOfCellsOrTheFirstNodes) {
  const std::string raw = test::raw_bytes<std::int32_t>(some_labels);
  const std::string mins = "axis mins: -1.0625 -0.5625 0.1875\nspacings: 0.125 0.125 0.125\n";
  expect_some_labels(read(header("int32", "raw", mins + "centers: cell cell cell\n") + raw));
  const std::string nodes = "axis mins: -1 -0.5 0.25\nspacings: 0.125 0.125 0.125\n";
  expect_some_labels(read(header("int32", "raw", nodes + "centerings: node node node\n") + raw));
  EXPECT_THAT(message_of(header("int32", "raw", nodes) + raw), HasSubstr("'centers'"));
}

TEST(Nrrd, WhatIsNotSupportedIsNamed) {
  EXPECT_THAT(message_with("type: int32", "type: float"), HasSubstr("field 'type' is 'float'"));
  EXPECT_THAT(message_with("dimension: 3\nsizes", "dimension: 4\nsizes"),
              HasSubstr("field 'dimension' is '4'"));
  EXPECT_THAT(message_with("sizes: 4 3 2", "sizes: 4 3"), HasSubstr("field 'sizes' is '4 3'"));
  EXPECT_THAT(message_with("sizes: 4 3 2", "sizes: 4 3 x"), HasSubstr("'4 3 x'"));
  EXPECT_THAT(message_with("sizes: 4 3 2", "sizes: 4 3 -2"), HasSubstr("'4 3 -2'"));
  EXPECT_THAT(message_with("sizes: 4 3 2", "sizes: 4 3 0"), HasSubstr("4 x 3 x 0"));
  EXPECT_THAT(message_with("encoding: raw", "encoding: bzip2"), HasSubstr("'bzip2'"));
  EXPECT_THAT(message_with("endian: little", "endian: middle"), HasSubstr("'middle'"));
  EXPECT_THAT(message_with("endian: little\n", ""), HasSubstr("no field 'endian'"));
  EXPECT_THAT(message_with("type: int32\n", ""), HasSubstr("no field 'type'"));
  EXPECT_THAT(message_with("NRRD0004", "NRRD0009"), HasSubstr("NRRD0009"));
  EXPECT_THAT(message_with("# a comment", "no field at all"), HasSubstr("no field at all"));
  EXPECT_THAT(message_with("# a comment", "type: int8"), HasSubstr("there twice"));
  EXPECT_THAT(message_with("# a comment", "data file: x.raw"), HasSubstr("'data file'"));
  EXPECT_THAT(message_with("# a comment", "byte skip: -1"), HasSubstr("'byte skip'"));
  EXPECT_THAT(message_with("# a comment", "kinds: domain domain vector"), HasSubstr("'kinds'"));
}

TEST(Nrrd, APlaceThatIsMissingOrNotThatOfAGridIsNamed) {
  EXPECT_THAT(message_with(place, ""), HasSubstr("where the voxels are"));
  EXPECT_THAT(message_with("(0.125,0,0) (0,0.125,0)", "(0,0.125,0) (0.125,0,0)"),
              HasSubstr("along x, y and z"));
  EXPECT_THAT(message_with("(0.125,0,0)", "(-0.125,0,0)"), HasSubstr("along x, y and z"));
  EXPECT_THAT(message_with("(0.125,0,0)", "(0.25,0,0)"), HasSubstr("cubic voxels"));
  EXPECT_THAT(message_with("(0.125,0,0)", "(nan,0,0)"), HasSubstr("finite"));
  EXPECT_THAT(message_with("(0.125,0,0)", "none"), HasSubstr("space directions"));
  EXPECT_THAT(message_with("(-1,-0.5,0.25)", "(-1,-0.5)"), HasSubstr("3 numbers"));
  EXPECT_THAT(message_with("space origin: (-1,-0.5,0.25)\n", ""), HasSubstr("'space origin'"));
}

TEST(Nrrd, DataThatDoNotMatchTheHeaderAreNamed) {
  const std::string raw = test::raw_bytes<std::int32_t>(some_labels);
  EXPECT_THAT(message_of(header("int32", "raw") + raw + "x"), HasSubstr("97 follow"));
  EXPECT_THAT(message_of(header("int32", "raw") + raw.substr(1)), HasSubstr("cut short"));
  EXPECT_THAT(message_of(header("int32", "gzip") + test::gzipped(raw.substr(4))),
              HasSubstr("23 whole values"));
  EXPECT_THAT(message_of(header("int32", "gzip") + test::gzipped(raw + "x")),
              HasSubstr("more data"));
  EXPECT_THAT(message_of(header("int32", "gzip") + raw), HasSubstr("damaged"));
  const std::string text = "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23";
  EXPECT_THAT(message_of(header("int32", "ascii") + text), HasSubstr("23 values"));
  EXPECT_THAT(message_of(header("int32", "ascii") + text + " 24 25"), HasSubstr("'25' follows"));
  EXPECT_THAT(message_of(header("int32", "ascii") + text + " 2.5"), HasSubstr("'2.5'"));
  EXPECT_THAT(message_of(header("int32", "ascii") + text + " 3000000000"),
              HasSubstr("voxel (3, 2, 1) holds 3000000000"));
  std::string wide = test::raw_bytes<std::uint64_t>(some_labels);  // -1 is 2^64 - 1
  EXPECT_THAT(message_of(header("uint64", "raw") + wide),
              HasSubstr("voxel (0, 1, 0) holds 18446744073709551615"));
}

TEST(Nrrd, AVolumeLargerThanMemoryIsRefusedBeforeMemoryIsTaken) {
  EXPECT_THAT(message_with("sizes: 4 3 2", "sizes: 100000 100000 100000"),
              HasSubstr("4000000.0 GB of memory"));
  EXPECT_THAT(message_with("sizes: 4 3 2", "sizes: 2000000000 2000000000 2000000000"),
              HasSubstr("GB of memory"));
  EXPECT_THAT(message_with("sizes: 4 3 2", "sizes: 99999999999999999999 1 1"),
              HasSubstr("'sizes'"));
}

TEST(Nrrd, EveryTruncationIsRefused) {
  const std::string raw = test::raw_bytes<std::int32_t>(some_labels);
  std::string text;
  for (const std::int32_t label : some_labels) text += std::to_string(label) + " ";
  text.pop_back();
  for (const std::string& whole :
       {header("int32", "raw") + raw, header("int32", "gzip") + test::gzipped(raw),
        header("int32", "ascii") + text}) {
    for (std::size_t length = 0; length < whole.size(); ++length) {
      EXPECT_NE(message_of(whole.substr(0, length)), "nothing was thrown") << length;
    }
  }
}

TEST(Nrrd, DamagedBytesGiveAnErrorOrAVolumeButNoCrash) {
  const std::string raw = test::raw_bytes<std::int32_t>(some_labels);
  Random random(1);
  for (const std::string& whole :
       {header("int32", "raw") + raw, header("int32", "gzip") + test::gzipped(raw)}) {
    for (std::size_t place_of_damage = 0; place_of_damage < whole.size(); ++place_of_damage) {
      std::string damaged = whole;
      damaged[place_of_damage] = static_cast<char>(random.below(256));
      try {
        const VoxelGrid<std::int32_t> labels = read(damaged);
        EXPECT_EQ(labels.values.size(), 24u);
      } catch (const InputError&) {
      }
    }
  }
}

TEST(LabelVolumes, AreNotLookedForInDevicesThatNeverEnd) {
  EXPECT_THROW(read_label_volume("/dev/zero"), InputError);
}

TEST(LabelVolumes, OfOtherKindsAreRefused) {
  EXPECT_THAT(message_of(""), HasSubstr("is empty"));
  EXPECT_THAT(message_of("solid thing"), HasSubstr("neither an NRRD nor an HDF5"));
  EXPECT_THROW(read_label_volume("/no/such/file.nrrd"), InputError);
  EXPECT_THROW(read_label_volume("/tmp"), InputError);
}

}  // namespace
}  // namespace fracbench
