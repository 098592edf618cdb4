#include "neural/volume.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <new>
#include <numeric>

#include "core/process_tree.h"

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

TEST(Volume, OfASizeThatWasGivenBackTakesItsPagesAgain) {
  const std::size_t count = (std::size_t{33} << 20) / sizeof(float);
  const float* before = nullptr;
  {
    const Volume volume(count, 1.0f);
    before = volume.data();
  }
  const Volume another(count + kLargeBytes, 2.0f), again(count);
  EXPECT_EQ(again.data(), before);
  EXPECT_EQ(again[count / 2], 1.0f);
  const Volume further(count, 3.0f);
  EXPECT_NE(further.data(), before);
}

TEST(Volume, GivenBackIsKeptUpToABound) {
  constexpr std::size_t kMany = 60, kBytes = std::size_t{16} << 20;
  const std::size_t before = resident_memory(::getpid());
  {
    const std::vector<Volume> many(kMany, Volume(kBytes / sizeof(float), 1.0f));
    EXPECT_GT(resident_memory(::getpid()), before + kMany * kBytes / 2);
  }
  EXPECT_LT(resident_memory(::getpid()), before + (std::size_t{300} << 20));
}

TEST(Volume, ThatIsTooLargeForAnyMemoryIsRefused) {
  EXPECT_THROW(map_huge_pages(SIZE_MAX), std::bad_alloc);
  EXPECT_THROW(map_huge_pages(std::size_t{1} << 60), std::bad_alloc);
}

}  // namespace
}  // namespace fracbench::neural
