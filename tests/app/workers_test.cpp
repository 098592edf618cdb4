#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>
#include <vector>

#include "tests/app/program.h"
#include "tests/core/best_time.h"
#include "tests/core/processes.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using ::testing::HasSubstr;

// A cell takes many seconds.
constexpr const char* kSlowSuite =
    "shapes = [\"sphere\"]\n"
    "[[scenario]]\nfamily = \"single\"\ncount = 4\nspeed_min = 90\nframes = 20\n"
    "[[method]]\nname = \"cvd\"\nsites = 5000\n";

constexpr const char* kQuickSuite =
    "[[shape]]\nname = \"cube\"\nresolution = 4\n"
    "[[scenario]]\nfamily = \"single\"\ncount = 3\nspeed_min = 90\nframes = 20\n"
    "[[method]]\nname = \"cvd\"\nsites = 5\n";

std::vector<::pid_t> children_of(::pid_t process) {
  std::vector<::pid_t> all;
  for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::ifstream children(task.path() / "children");
    for (::pid_t child = 0; children >> child;) all.push_back(child);
  }
  return all;
}

/// The program measuring the suite of a folder with two workers, which are at work.
struct Running {
  explicit Running(const fs::path& folder) {
    id = ::fork();
    if (id == 0) {
      const int nowhere = ::open("/dev/null", O_RDWR);
      for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
      if (::chdir(folder.c_str()) != 0) ::_exit(99);
      ::execl(FRACBENCH_PROGRAM, FRACBENCH_PROGRAM, "run", "slow.toml", "--out", "results",
              "--jobs", "2", nullptr);
      ::_exit(98);
    }
    for (int k = 0; k < 1000 && workers.size() < 2; ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      workers = children_of(id);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  ::pid_t id = -1;
  std::vector<::pid_t> workers;
};

class Workers : public ::testing::Test {
 protected:
  Workers() {
    folder_.write("slow.toml", kSlowSuite);
    folder_.write("quick.toml", kQuickSuite);
  }
  TemporaryFolder folder_;
};

TEST_F(Workers, AreEndedWithinASecondOfAnInterrupt) {
  const auto interrupted_run = [&] {
    const Running run(folder_.path());
    EXPECT_EQ(run.workers.size(), 2);
    const auto asked = Clock::now();
    ::kill(run.id, SIGINT);
    int status = 0;
    EXPECT_EQ(::waitpid(run.id, &status, 0), run.id);
    const auto ended = Clock::now();
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 4);
    EXPECT_TRUE(all_gone(run.workers));
    return ended - asked;
  };
  constexpr std::chrono::seconds kLimit(1);
  EXPECT_LT(best_time(kLimit, interrupted_run), kLimit);
}

TEST_F(Workers, EndWithAProgramThatIsKilled) {
  const Running run(folder_.path());
  ASSERT_EQ(run.workers.size(), 2);
  ::kill(run.id, SIGKILL);
  ::waitpid(run.id, nullptr, 0);
  EXPECT_TRUE(all_gone(run.workers));
}

TEST_F(Workers, ThatAreKilledCostTheirCellAndNothingElse) {
  const Running run(folder_.path());
  ASSERT_EQ(run.workers.size(), 2);
  ::kill(run.workers[0], SIGKILL);
  for (int k = 0; k < 500 && fs::is_empty(folder_.path() / "results/records"); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(fs::is_empty(folder_.path() / "results/records"));
  EXPECT_TRUE(is_alive(run.id));
  EXPECT_TRUE(is_alive(run.workers[1]));
  ::kill(run.id, SIGINT);
  ::waitpid(run.id, nullptr, 0);
}

TEST_F(Workers, HoldTheLimitsOfTheSuite) {
  const auto slow = call(
      "run slow.toml --out slow --json --set timeout_s=0.3 --set "
      "scenario.single.count=1",
      folder_.path());
  EXPECT_EQ(slow.exit_code, 4) << slow.errors;
  EXPECT_EQ(slow.json()["timeout"], 1);
  const auto large = call("run quick.toml --out large --json --set memory_mb=5", folder_.path());
  EXPECT_EQ(large.json()["out-of-memory"], 3) << large.output;
  const auto again = call("run quick.toml --out large --json --set memory_mb=0", folder_.path());
  EXPECT_EQ(again.json()["ok"], 3);
  EXPECT_THAT(again.errors, HasSubstr("memory_mb = 5"));
}

TEST_F(Workers, AreNotNeededToMeasureInProcess) {
  const auto here = call("run quick.toml --out results --in-process --json", folder_.path());
  ASSERT_EQ(here.exit_code, 0) << here.errors;
  EXPECT_EQ(here.json()["ok"], 3);
  // The same cells, so that nothing is left to do.
  EXPECT_EQ(call("run quick.toml --out results --json", folder_.path()).json()["found"], 3);
}

TEST_F(Workers, AreStartedByNobodyElse) {
  const auto answer = call("worker", folder_.path());
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.errors, HasSubstr("fracbench run"));
  EXPECT_THAT(call("--help", folder_.path()).output, ::testing::Not(HasSubstr("worker")));
}

}  // namespace
}  // namespace fracbench
