#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/error.h"
#include "core/random.h"
#include "geometry/read_label_volume.h"
#include "volume_files.h"

namespace fracbench {
namespace {

using test::Hdf5Volume;
using test::write_hdf5;
using testing::HasSubstr;

const std::vector<std::int64_t> some_labels = {0, 1, 2,  3,   101, 5, 6, 7, 8, 9, 10, 11,
                                               4, 3, 17, 100, 0,   7, 1, 1, 1, 2, 2,  0};

VoxelGrid<std::int32_t> read(const Hdf5Volume& volume) {
  const test::ScratchFile file(".h5");
  write_hdf5(file.path(), volume);
  return read_label_volume(file.path());
}

std::string message_of(const Hdf5Volume& volume) {
  try {
    read(volume);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Hdf5Labels, EveryIntegerTypeIsReadWithXFastest) {
  for (const hid_t type : {H5T_STD_I8LE, H5T_STD_U8BE, H5T_STD_I16BE, H5T_STD_U16LE, H5T_STD_I32BE,
                           H5T_STD_U32LE, H5T_STD_I64LE, H5T_STD_U64BE}) {
    for (const bool compressed : {false, true}) {
      const auto labels = read({.type = type, .values = some_labels, .compressed = compressed});
      EXPECT_EQ(labels.size, (std::array<std::int32_t, 3>{4, 3, 2}));
      EXPECT_TRUE(std::equal(some_labels.begin(), some_labels.end(), labels.values.begin(),
                             labels.values.end()));
      EXPECT_EQ(labels.at(0, 1, 0), 101);
      EXPECT_EQ(labels.spacing, 0.125);
      EXPECT_EQ(labels.origin, Vec3(-1, -0.5, 0.25));
    }
  }
}

TEST(Hdf5Labels, WhatIsMissingOrOfTheWrongKindIsNamed) {
  EXPECT_THAT(message_of({.values = some_labels, .name = "label"}), HasSubstr("'labels'"));
  EXPECT_THAT(message_of({.type = H5T_IEEE_F32LE, .values = some_labels}),
              HasSubstr("does not hold integers"));
  EXPECT_THAT(message_of({.values = some_labels, .origin = {}}), HasSubstr("'origin'"));
  EXPECT_THAT(message_of({.values = some_labels, .spacing = {}}), HasSubstr("'spacing'"));
  EXPECT_THAT(message_of({.values = some_labels, .origin = {1, 2}}), HasSubstr("'origin'"));
  EXPECT_THAT(message_of({.values = some_labels, .origin = {1}}), HasSubstr("one number"));
  EXPECT_THAT(message_of({.values = some_labels, .origin = {1, 2, std::nan("")}}),
              HasSubstr("'origin' holds nan"));
  EXPECT_THAT(message_of({.values = some_labels, .spacing = {0}}), HasSubstr("positive"));
  EXPECT_THAT(message_of({.values = some_labels, .spacing = {1, 1, 2}}), HasSubstr("1 x 1 x 2"));
  EXPECT_EQ(read({.values = some_labels, .spacing = {2, 2, 2}}).spacing, 2);
}

TEST(Hdf5Labels, ValuesBeyond32BitsAreRefused) {
  std::vector<std::int64_t> labels = some_labels;
  labels[7] = std::int64_t{1} << 40;
  EXPECT_THAT(message_of({.type = H5T_STD_I64LE, .values = labels}), HasSubstr("1099511627776"));
  labels[7] = std::int64_t{3} << 30;
  EXPECT_THAT(message_of({.type = H5T_STD_U32LE, .values = labels}), HasSubstr("3221225472"));
}

TEST(Hdf5Labels, AVolumeLargerThanMemoryIsRefusedBeforeMemoryIsTaken) {
  EXPECT_THAT(message_of({.shape = {200000, 200000, 200000}}), HasSubstr("GB of memory"));
}

TEST(Hdf5Labels, EveryTruncationIsRefused) {
  const test::ScratchFile whole(".h5"), cut(".h5");
  write_hdf5(whole.path(), {.values = some_labels, .compressed = true});
  const std::string bytes = whole.read();
  for (std::size_t length = 0; length < bytes.size(); length += 29) {
    cut.write(bytes.substr(0, length));
    EXPECT_THROW(read_label_volume(cut.path()), InputError) << length;
  }
}

TEST(Hdf5Labels, DamagedBytesGiveAnErrorOrAVolumeButNoCrash) {
  const test::ScratchFile whole(".h5"), damaged(".h5");
  Random random(2);
  for (const bool compressed : {false, true}) {
    write_hdf5(whole.path(), {.values = some_labels, .compressed = compressed});
    const std::string bytes = whole.read();
    for (std::size_t place = 0; place < bytes.size(); ++place) {
      // Most of the file is empty.
      if (random.uniform() > (bytes[place] == 0 ? 0.02 : 0.5)) continue;
      std::string changed = bytes;
      changed[place] = static_cast<char>(random.below(256));
      damaged.write(changed);
      try {
        read_label_volume(damaged.path());
      } catch (const InputError&) {
      }
    }
  }
}

}  // namespace
}  // namespace fracbench
