// A run whose accesses to the disk fail one after the other: whatever fails, and wherever it is
// killed, no record is half there and the next run ends with the same records.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "core/error.h"
#include "harness/record_store.h"
#include "harness/runner.h"
#include "harness/suite_overrides.h"
#include "stored_results.h"
#include "temporary_folder.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolderVariable = "FRACBENCH_FAULT_TEST_FOLDER";
constexpr int kFailed = 7;  // exit code of a run that said what is wrong

Plan fault_plan(const Catalog& catalog) {
  return make_plan(with_override(toy_suite(catalog), "scenario.*.count=1", catalog), catalog);
}

// Not a test of its own: what the tests below start.
TEST(FaultTest, DISABLED_FillsAFolder) {
  if (!std::getenv(kFolderVariable)) GTEST_SKIP() << "started by the other tests of this file";
  const ToyWorld world;
  const Catalog catalog = world.catalog();
  try {
    run_suite(fault_plan(catalog), catalog, {.folder = std::getenv(kFolderVariable)});
  } catch (const InputError&) {
    ::_exit(kFailed);
  }
}

using Environment = std::map<std::string, std::string>;

/// This same program with the faults of `environment`, filling a folder; how it ended.
int fill(const fs::path& folder, Environment environment) {
  environment["LD_PRELOAD"] = FRACBENCH_FAULT_SHIM;
  environment["FAULT_FOLDER"] = folder;
  environment[kFolderVariable] = folder;
  const ::pid_t child = ::fork();
  if (child == 0) {
    const ::rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
    const int quiet = ::open("/dev/null", O_WRONLY);
    ::dup2(quiet, STDOUT_FILENO);
    ::dup2(quiet, STDERR_FILENO);
    ::execl("/proc/self/exe", "test_harness", "--gtest_also_run_disabled_tests",
            "--gtest_filter=FaultTest.DISABLED_FillsAFolder", nullptr);
    ::_exit(99);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  return status;
}

class FaultyRunTest : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers want to be loaded first";
#endif
    ASSERT_TRUE(run_suite(plan_, catalog_, {.folder = base() / "alone"}).complete());
    alone_ = stored_results(base() / "alone");
  }

  const fs::path& base() const { return temporary_.path(); }

  TemporaryFolder temporary_;
  ToyWorld world_;
  Catalog catalog_ = world_.catalog();
  Plan plan_ = fault_plan(catalog_);
  std::map<std::string, DataTree::Array> alone_;
};

TEST_P(FaultyRunTest, LosesNothingWhereverItStrikes) {
  const std::string& kind = GetParam();
  const bool kills = kind.starts_with("kill");
  const fs::path count = base() / "count";
  std::ofstream(count) << "";
  fill(base() / "counted", {{"FAULT_KIND", kind}, {"FAULT_AT", "0"}, {"FAULT_COUNT", count}});
  const auto calls = static_cast<int>(fs::file_size(count));
  ASSERT_GT(calls, 15) << "accesses to the disk are not seen";
  int failed = 0;
  for (int at = 1; at <= calls; ++at) {
    SCOPED_TRACE(kind + " at call " + std::to_string(at));
    const fs::path folder = base() / std::to_string(at);
    const int status = fill(folder, {{"FAULT_KIND", kind}, {"FAULT_AT", std::to_string(at)}});
    if (kills) {
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    } else {
      // What does not matter, such as a file that stays behind, is passed over; else it is told.
      ASSERT_TRUE(WIFEXITED(status));
      EXPECT_TRUE(WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == kFailed)
          << WEXITSTATUS(status);
      failed += WEXITSTATUS(status) == kFailed;
      if (WEXITSTATUS(status) == 0) {
        EXPECT_TRUE(stored_results(folder) == alone_) << "said to be done";
      }
    }
    ASSERT_NO_THROW(stored_results(folder));
    ASSERT_TRUE(run_suite(plan_, catalog_, {.folder = folder}).complete());
    EXPECT_TRUE(stored_results(folder) == alone_);
    for (const auto& item : fs::directory_iterator(folder / "records")) {
      EXPECT_EQ(item.path().extension(), ".h5") << item.path();
    }
    fs::remove_all(folder);
  }
  if (!kills) {
    EXPECT_GT(failed, calls / 4) << "failures are not seen";
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FaultyRunTest,
                         testing::Values("full", "error", "kill", "kill-after"));

class ShortAccess : public FaultyRunTest {};

TEST_P(ShortAccess, WritesAndReadsThatDoHalfOfWhatTheyAreAskedForAreGoneOnWith) {
  const fs::path folder = base() / "short";
  for (int round = 0; round < 2; ++round) {  // the second reads what the first has written
    const int status = fill(folder, {{"FAULT_KIND", GetParam()}});
    ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
    EXPECT_TRUE(stored_results(folder) == alone_);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShortAccess, testing::Values("short"));

}  // namespace
}  // namespace fracbench
