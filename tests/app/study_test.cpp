#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/app/program.h"
#include "tests/core/best_time.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kSuite =
    "[study]\nside = 16\npatterns = 2\nleast_sites = 3\nmost_sites = 4\nepochs = 3\n"
    "[scale.paper]\nsummary = \"larger\"\nset = [\"study.epochs=7\"]\n";

class Study : public ::testing::Test {
 protected:
  Study() { folder_.write("study.toml", kSuite); }
  Answer run(const std::string& more = "") {
    return call("run study.toml --out results " + more, folder_.path());
  }
  TemporaryFolder folder_;
};

TEST_F(Study, IsMadeOnceAndReportedWithPictures) {
  const Answer dry = run("--dry-run");
  EXPECT_EQ(dry.exit_code, 0) << dry.errors;
  EXPECT_THAT(dry.output,
              AllOf(HasSubstr("x 3 epochs x 2 patterns, about 1 s\n"),
                    HasSubstr("--scale paper (larger): study: 3 representations x 7 epochs x 2 "
                              "patterns, about 1 s\n")));
  const nlohmann::json cost = run("--dry-run --json").json();
  EXPECT_EQ(cost["found"], false);
  EXPECT_GT(cost["seconds"], 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "results"));

  EXPECT_EQ(run("--json").json()["found"], false);
  const std::string made = folder_.read("results/study.data");
  EXPECT_EQ(run("--json").json()["found"], true);
  EXPECT_EQ(folder_.read("results/study.data"), made);
  EXPECT_EQ(run("--dry-run --json").json()["found"], true);
  EXPECT_THAT(run("--dry-run").output, HasSubstr("x 3 epochs x 2 patterns, done\n"));

  const Answer report = call("report results", folder_.path());
  ASSERT_EQ(report.exit_code, 0) << report.errors;
  EXPECT_THAT(folder_.read("results/report/report.md"),
              AllOf(HasSubstr("| labels"), HasSubstr("representation_lines.png")));
  EXPECT_THAT(
      folder_.read("results/report/index.html"),
      AllOf(HasSubstr("src=\"representation_distance.png\""), HasSubstr("study"),
            ::testing::Not(HasSubstr("#viewer")), ::testing::Not(HasSubstr("id=\"cells\""))));
  for (const char* name : {"labels", "lines", "distance"}) {
    const std::string png = "results/report/representation_" + std::string(name) + ".png";
    EXPECT_EQ(folder_.read(png).substr(1, 3), "PNG");
  }
}

/// A study that takes some seconds, and its file of check points of one training.
constexpr const char* kLonger =
    "[study]\nside = 32\npatterns = 4\nleast_sites = 3\nmost_sites = 4\nepochs = 100\n";

class StoppedStudy : public ::testing::Test {
 protected:
  using Clock = std::chrono::steady_clock;

  StoppedStudy() { folder_.write("study.toml", kLonger); }

  /// Starts it, and sends it that signal once one training has a check point; returns how it ended.
  int end_after(const std::string& training, int signal) {
    const ::pid_t child = ::fork();
    if (child == 0) {
      if (::chdir(folder_.path().c_str()) != 0) ::_exit(99);
      ::dup2(::open("out", O_CREAT | O_WRONLY | O_TRUNC, 0600), 1);
      ::dup2(::open("err", O_CREAT | O_WRONLY | O_TRUNC, 0600), 2);
      ::execl(FRACBENCH_PROGRAM, FRACBENCH_PROGRAM, "run", "study.toml", "--out", "results",
              nullptr);
      ::_exit(98);
    }
    int status = 0;
    while (!fs::exists(checkpoints() / training / "training.checkpoint")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (::waitpid(child, &status, WNOHANG) == child) return status;
    }
    asked_ = Clock::now();
    ::kill(child, signal);
    ::waitpid(child, &status, 0);
    return status;
  }
  fs::path checkpoints() const { return folder_.path() / "results/study.data.checkpoints"; }

  TemporaryFolder folder_;
  Clock::time_point asked_;
};

TEST_F(StoppedStudy, SaysHowToGoOnAndEndsInTheSameBytes) {
  ASSERT_EQ(call("run study.toml --out whole", folder_.path()).exit_code, 0);
  int stopped = 0;
  const auto stopped_study = [&] {
    fs::remove_all(folder_.path() / "results");
    stopped = end_after("labels", SIGINT);
    return Clock::now() - asked_;
  };
  constexpr std::chrono::seconds kLimit(1);
  EXPECT_LT(best_time(kLimit, stopped_study), kLimit);
  ASSERT_TRUE(WIFEXITED(stopped));
  EXPECT_EQ(WEXITSTATUS(stopped), 4) << folder_.read("err");
  EXPECT_THAT(folder_.read("out"), HasSubstr("stopped; the same command goes on from here"));

  const int killed = end_after("lines", SIGKILL);
  EXPECT_TRUE(WIFSIGNALED(killed));
  EXPECT_FALSE(fs::exists(folder_.path() / "results/study.data"));

  const Answer done = call("run study.toml --out results", folder_.path());
  EXPECT_EQ(done.exit_code, 0) << done.errors;
  EXPECT_THAT(done.errors, ::testing::Not(HasSubstr("anew")));
  EXPECT_EQ(folder_.read("results/study.data"), folder_.read("whole/study.data"));
  EXPECT_FALSE(fs::exists(checkpoints()));
}

TEST_F(StoppedStudy, WithADamagedCheckPointTellsOfItAndBeginsThatAnew) {
  ASSERT_EQ(call("run study.toml --out whole", folder_.path()).exit_code, 0);
  end_after("lines", SIGINT);
  const fs::path labels = checkpoints() / "labels" / "training.checkpoint";
  fs::resize_file(labels, fs::file_size(labels) / 2);
  const Answer done = call("run study.toml --out results", folder_.path());
  EXPECT_EQ(done.exit_code, 0) << done.errors;
  EXPECT_THAT(done.errors, AllOf(HasSubstr("labels/training.checkpoint"), HasSubstr("damaged"),
                                 HasSubstr("labels begin anew")));
  EXPECT_EQ(folder_.read("results/study.data"), folder_.read("whole/study.data"));
}

TEST_F(Study, ThatIsDamagedIsLeftOutOfReportsAndMadeAgain) {
  ASSERT_EQ(run().exit_code, 0);
  const fs::path file = folder_.path() / "results/study.data";
  const std::string made = folder_.read("results/study.data");
  fs::resize_file(file, fs::file_size(file) / 2);
  const Answer report = call("report results", folder_.path());
  EXPECT_EQ(report.exit_code, 4);
  EXPECT_THAT(report.errors, AllOf(HasSubstr("study.data"), HasSubstr("run")));
  const Answer again = run();
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.errors, HasSubstr("made again"));
  EXPECT_EQ(folder_.read("results/study.data"), made);
}

TEST_F(Study, WithOtherSettingsNeedsAnotherFolder) {
  ASSERT_EQ(run().exit_code, 0);
  const Answer other = run("--set study.epochs=4");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.errors, HasSubstr("study.epochs: 3 there, 4 here"));
}

TEST_F(Study, BadSuitesAreRefusedWithTheWayOut) {
  const auto message = [&](const std::string& suite, const std::string& more = "") {
    folder_.write("bad.toml", suite);
    const Answer answer = call("run bad.toml " + more, folder_.path());
    EXPECT_EQ(answer.exit_code, 2);
    return answer.errors;
  };
  EXPECT_THAT(message("[study]\nepoch = 3\n"),
              AllOf(HasSubstr("bad.toml:2"), HasSubstr("did you mean 'epochs'")));
  EXPECT_THAT(message("[study]\nside = 48\nepochs = 1\n"), HasSubstr("power of two"));
  EXPECT_THAT(message("shapes = [\"cube\"]\n[study]\n"), HasSubstr("another suite"));
  EXPECT_THAT(message("[study]\n", "--set study.kind=other"), HasSubstr("representations"));
  const Answer prepare = call("prepare study.toml", folder_.path());
  EXPECT_EQ(prepare.exit_code, 2);
  EXPECT_THAT(prepare.errors, HasSubstr("fracbench run study.toml"));
}

}  // namespace
}  // namespace fracbench
