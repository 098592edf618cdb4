#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "core/random.h"
#include "harness/data_file.h"
#include "harness/learning_data.h"
#include "harness/learning_plan.h"
#include "harness/record_store.h"
#include "harness/suite_overrides.h"
#include "harness/suite_reader.h"
#include "learning_world.h"
#include "stored_results.h"
#include "temporary_folder.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolderVariable = "FRACBENCH_LEARNING_KILL_TEST_FOLDER";
constexpr int kKills = 10;
constexpr std::size_t kRecords = 60;

LearningResult make(const fs::path& folder, int jobs) {
  const LearningWorld world;
  const Catalog catalog = world.catalog();
  const Suite suite = with_override(parse_suite(learning_suite_text(), "toys.toml", catalog),
                                    "learning.options.wait=0.004", catalog);
  return make_learning_data(make_learning_plan(suite, catalog), suite.learning->split, catalog,
                            {.folder = folder, .jobs = jobs});
}

std::string index_bytes(const fs::path& folder) {
  std::ifstream stream(folder / "learning.json", std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Not a test of its own: what the test below starts and kills.
TEST(LearningKillTest, DISABLED_MakesLearningData) {
  const char* folder = std::getenv(kFolderVariable);
  if (!folder) GTEST_SKIP() << "started by the other test of this file";
  EXPECT_EQ(exit_code_of(make(folder, 2)), ExitCode::good);
}

::pid_t start(const fs::path& folder) {
  const ::pid_t child = ::fork();
  if (child != 0) return child;
  ::setenv(kFolderVariable, folder.c_str(), 1);
  ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
  ::execl("/proc/self/exe", "test_harness", "--gtest_also_run_disabled_tests",
          "--gtest_filter=LearningKillTest.DISABLED_MakesLearningData", nullptr);
  ::_exit(99);
}

TEST(LearningKillTest, KilledAndResumedItIsTheSameBytesAsWhenItWasLeftAlone) {
  const TemporaryFolder temporary;
  const fs::path& base = temporary.path();
  make(base / "alone", 1);
  Random random(7);
  std::size_t records = 0;
  int partly = 0;  // kills that left some records and not all
  int status = -1;
  for (int attempt = 0; attempt <= kKills; ++attempt) {
    const ::pid_t child = start(base / "killed");
    ASSERT_GT(child, 0);
    if (attempt < kKills) {
      // Some come while it starts; the others once there is a new record, however slow it is.
      if (attempt % 3 != 0) wait_for_records(base / "killed", records + 1, child);
      std::this_thread::sleep_for(std::chrono::duration<double>(random.uniform(0, 0.03)));
      ::kill(child, SIGKILL);
    }
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    records = list_records(base / "killed").size();
    partly += records > 0 && records < kRecords;
    // Whole or not there.
    const std::string bytes = index_bytes(base / "killed");
    if (!bytes.empty()) {
      ASSERT_EQ(bytes, index_bytes(base / "alone"));
    }
  }
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(list_records(base / "killed").size(), kRecords);
  EXPECT_GE(partly, 2) << "the kills came too early or too late to mean anything";
  EXPECT_EQ(index_bytes(base / "killed"), index_bytes(base / "alone"));
  EXPECT_TRUE(stored_results(base / "killed") == stored_results(base / "alone"));
}

}  // namespace
}  // namespace fracbench
