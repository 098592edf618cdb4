#include "neural/volume.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <new>
#include <numeric>

namespace fracbench::neural {
namespace {

TEST(Volume, KeepsItsNumbersWhateverItsSize) {
  for (const std::size_t count : {std::size_t{3}, kLargeBytes / sizeof(float) - 1,
                                  kLargeBytes / sizeof(float), std::size_t{3'000'001}}) {
    Volume volume(count);
    std::iota(volume.begin(), volume.end(), 1.0f);
    const Volume copy = volume;
    const Volume moved = std::move(volume);
    EXPECT_EQ(moved.front(), 1);
    EXPECT_EQ(moved.back(), static_cast<float>(count));
    EXPECT_EQ(copy, moved);
  }
}

TEST(Volume, ThatIsLargeBeginsWhereAHugePageCan) {
  for (int k = 0; k < 10; ++k) {
    const std::vector<Volume> several(3, Volume(kLargeBytes / sizeof(float) + 1000));
    for (const Volume& volume : several) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(volume.data()) % (2 << 20), 0);
    }
  }
}

TEST(Volume, ThatIsTooLargeForAnyMemoryIsRefused) {
  EXPECT_THROW(map_huge_pages(SIZE_MAX), std::bad_alloc);
  EXPECT_THROW(map_huge_pages(std::size_t{1} << 60), std::bad_alloc);
}

}  // namespace
}  // namespace fracbench::neural
