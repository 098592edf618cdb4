#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <thread>

#include "core/random.h"
#include "harness/record_store.h"
#include "harness/runner.h"
#include "harness/suite_overrides.h"
#include "stored_results.h"
#include "temporary_folder.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolderVariable = "FRACBENCH_KILL_TEST_FOLDER";
constexpr const char* kJobsVariable = "FRACBENCH_KILL_TEST_JOBS";
constexpr int kKills = 15;

Plan kill_plan(const Catalog& catalog) {
  Suite suite = with_override(toy_suite(catalog), "repeats=5", catalog);
  suite = with_override(suite, "method.*.wait=0.004", catalog);
  return make_plan(suite, catalog);
}

/// This same program, filling a folder; see the disabled test below.
/// With a limit on the size of files it is killed by the system in the middle of writing one.
::pid_t start_run(const fs::path& folder, int jobs, ::rlim_t largest_file = RLIM_INFINITY) {
  const ::pid_t child = ::fork();
  if (child != 0) return child;
  const ::rlimit file_limit{largest_file, largest_file};
  const ::rlimit no_core{0, 0};
  if (largest_file != RLIM_INFINITY) ::setrlimit(RLIMIT_FSIZE, &file_limit);
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::setenv(kFolderVariable, folder.c_str(), 1);
  ::setenv(kJobsVariable, std::to_string(jobs).c_str(), 1);
  const int quiet = ::open("/dev/null", O_WRONLY);
  ::dup2(quiet, STDOUT_FILENO);
  ::execl("/proc/self/exe", "test_harness", "--gtest_also_run_disabled_tests",
          "--gtest_filter=KillTest.DISABLED_FillsAFolder", nullptr);
  ::_exit(99);
}

// Not a test of its own: what the tests below start and kill.
TEST(KillTest, DISABLED_FillsAFolder) {
  if (!std::getenv(kFolderVariable)) GTEST_SKIP() << "started by the other tests of this file";
  const ToyWorld world;
  const Catalog catalog = world.catalog();
  const RunResult result = run_suite(
      kill_plan(catalog), catalog,
      {.folder = std::getenv(kFolderVariable), .jobs = std::atoi(std::getenv(kJobsVariable))});
  EXPECT_TRUE(result.complete());
}

class KilledRunTest : public testing::TestWithParam<int> {};

TEST_P(KilledRunTest, GivesTheSameRecordsAsOneThatWasLeftAlone) {
  const int jobs = GetParam();
  const TemporaryFolder temporary;
  const fs::path& base = temporary.path();
  const ToyWorld world;
  const Catalog catalog = world.catalog();
  const Plan plan = kill_plan(catalog);
  ASSERT_TRUE(run_suite(plan, catalog, {.folder = base / "alone"}).complete());

  Random random(20 + static_cast<std::uint64_t>(jobs));
  int killed = 0;
  std::size_t records = 0;
  std::size_t partly = 0;  // kills that left some records and not all
  int status = -1;
  for (int attempt = 0; attempt <= kKills; ++attempt) {
    const ::pid_t child = start_run(base / "killed", jobs);
    ASSERT_GT(child, 0);
    if (attempt < kKills) {
      // Some come while it starts; the others once there is a new record, however slow it is.
      if (attempt % 3 != 0) wait_for_records(base / "killed", records + 1, child);
      std::this_thread::sleep_for(std::chrono::duration<double>(random.uniform(0, 0.02)));
      ::kill(child, SIGKILL);
    }
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    killed += WIFSIGNALED(status);
    records = list_records(base / "killed").size();
    partly += records > 0 && records < plan.cells.size();
    ASSERT_NO_THROW(stored_results(base / "killed")) << "after kill " << attempt;
  }
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_GE(partly, 2) << "the kills came too early or too late to mean anything";
  EXPECT_GE(killed, 3);
  EXPECT_EQ(list_records(base / "killed").size(), plan.cells.size());
  EXPECT_TRUE(stored_results(base / "killed") == stored_results(base / "alone"));
  for (const auto& item : fs::directory_iterator(base / "killed" / "records")) {
    EXPECT_EQ(item.path().extension(), ".h5");
  }
}

TEST(KillTest, InTheMiddleOfWritingARecordLeavesNone) {
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "killed";
  int status = 0;
  const ::pid_t child = start_run(folder, 1, 10000);
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_EQ(WTERMSIG(status), SIGXFSZ);
  EXPECT_TRUE(list_records(folder).empty());
  std::size_t half_written = 0;
  for (const auto& item : fs::directory_iterator(folder / "records")) {
    half_written += item.file_size() == 10000;
  }
  EXPECT_EQ(half_written, 1);

  const ToyWorld world;
  const Catalog catalog = world.catalog();
  EXPECT_TRUE(run_suite(kill_plan(catalog), catalog, {.folder = folder, .jobs = 2}).complete());
  for (const auto& item : fs::directory_iterator(folder / "records")) {
    EXPECT_EQ(item.path().extension(), ".h5");
  }
}

INSTANTIATE_TEST_SUITE_P(Jobs, KilledRunTest, testing::Values(1, 2));

}  // namespace
}  // namespace fracbench
