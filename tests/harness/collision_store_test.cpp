#include "harness/collision_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "harness/cell_executor.h"
#include "harness/learning_data.h"
#include "harness/learning_plan.h"
#include "harness/suite_reader.h"
#include "learning_world.h"
#include "temporary_folder.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class CollisionStoreTest : public testing::Test {
 protected:
  /// Makes the learning data in that folder through the store.
  LearningResult make(const std::string& folder) {
    return make_learning_data(
        plan, suite.learning->split, catalog,
        {.folder = base / folder, .jobs = 2, .execute = store.through(plan, counting())});
  }
  ExecuteCell counting() {
    return [this](const Cell& cell, Progress& progress, const std::stop_token& stop) {
      ++measured;
      if (milliseconds > 0) std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      return executor.execute(cell, progress, stop);
    };
  }
  static std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::vector<fs::path> kept() const {
    std::vector<fs::path> files;
    for (const auto& item : fs::recursive_directory_iterator(store_folder / "collisions")) {
      if (item.path().extension() == ".h5") files.push_back(item.path());
    }
    return files;
  }

  LearningWorld world;
  Catalog catalog = world.catalog();
  Suite suite = parse_suite(learning_suite_text(), "toys.toml", catalog);
  Plan plan = make_learning_plan(suite, catalog, {"box"});
  CellExecutor executor{plan, catalog, false};
  TemporaryFolder temporary;
  fs::path base = temporary.path(), store_folder = base / "cache";
  CollisionStore store{store_folder};
  std::atomic<int> measured = 0;
  int milliseconds = 0;
};

TEST_F(CollisionStoreTest, AnotherFolderTakesWhatOneHasMeasured) {
  const LearningResult first = make("one");
  ASSERT_TRUE(first.index.has_value());
  EXPECT_EQ(measured, 30);
  const std::size_t failed = first.index->shapes[0].count(LearningRole::failed);
  EXPECT_GT(failed, 0u);
  make("two");
  EXPECT_EQ(measured, 30 + static_cast<int>(failed)) << "what failed is tried again";
  EXPECT_EQ(bytes_of(base / "one/learning.json"), bytes_of(base / "two/learning.json"));
  for (const fs::path& file : kept()) {
    EXPECT_EQ(bytes_of(base / "two/records" / file.filename()),
              bytes_of(base / "one/records" / file.filename()));
  }

  const std::vector<CacheEntry> list = store.list(true);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].method, "halves");
  EXPECT_EQ(list[0].shape, "box");
  EXPECT_EQ(list[0].collisions, 30 - failed);
  EXPECT_GT(list[0].bytes, 0u);
  EXPECT_EQ(list[0].complaint, "");
  EXPECT_TRUE(store.remove(list[0].key));
  EXPECT_FALSE(store.remove(list[0].key));
  EXPECT_TRUE(store.list().empty());
}

TEST_F(CollisionStoreTest, TwoThatWantTheSameMeasureItOnce) {
  milliseconds = 20;
  std::thread other([&] { make("one"); });
  const LearningResult result = make("two");
  other.join();
  // What failed was not kept, and each of them has measured it.
  EXPECT_EQ(measured, 30 + static_cast<int>(result.index->shapes[0].count(LearningRole::failed)));
}

TEST_F(CollisionStoreTest, DamagedCollisionsAreMeasuredAnew) {
  make("one");
  const fs::path file = kept().front();
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_THAT(store.list(true)[0].complaint, HasSubstr(file.filename().string()));
  EXPECT_EQ(store.list(false)[0].complaint, "");
  const int before = measured;
  testing::internal::CaptureStderr();
  const LearningResult again = make("two");
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("made anew"));
  EXPECT_EQ(measured - before,
            1 + static_cast<int>(again.index->shapes[0].count(LearningRole::failed)));
  EXPECT_EQ(store.list(true)[0].complaint, "");
  EXPECT_EQ(bytes_of(base / "one/learning.json"), bytes_of(base / "two/learning.json"));

  // The record of another cell under this one's name is damage, too.
  fs::copy_file(kept()[1], kept()[0], fs::copy_options::overwrite_existing);
  const std::string key = store.list()[0].key;
  const std::size_t all = kept().size();
  EXPECT_NE(store.list(true)[0].complaint, "");
  store.remove_damaged(key);
  EXPECT_EQ(kept().size(), all - 1);
  EXPECT_EQ(store.list(true)[0].complaint, "");
}

TEST_F(CollisionStoreTest, WhereItCannotWriteNothingIsKept) {
  std::ofstream(store_folder) << "no folder";
  testing::internal::CaptureStderr();
  EXPECT_TRUE(make("one").index.has_value());
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("FRACBENCH_CACHE"));
  EXPECT_EQ(measured, 30);
}

}  // namespace
}  // namespace fracbench
