#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "neural/model.h"
#include "tests/core/processes.h"
#include "tests/neural/made_up_data.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

/// The program as a user calls it, in an empty folder with a small data set.
class TrainProgram : public ::testing::Test {
 protected:
  TrainProgram() {
    std::string name = (fs::temp_directory_path() / "fracbench-train-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    folder_ = name;
    neural::write_data_set(folder_ / "ball.data", test::made_up_data(3, {32}));
  }
  ~TrainProgram() override { fs::remove_all(folder_); }

  ::pid_t start(std::vector<std::string> arguments) const {
    fs::remove(folder_ / "out");  // what a test waits for is this call's
    const ::pid_t child = ::fork();
    if (child != 0) return child;
    const auto to = [&](const char* name, int stream) {
      ::dup2(::open((folder_ / name).c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), stream);
    };
    to("out", 1);
    to("err", 2);
    if (::chdir(folder_.c_str()) != 0) ::_exit(99);
    arguments.insert(arguments.begin(), FRACBENCH_TRAIN_PROGRAM);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    ::execv(pointers[0], pointers.data());
    ::_exit(98);
  }

  /// Exit code, or minus the signal.
  static int end_of_status(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  static int end_of(::pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return end_of_status(status);
  }
  int call(const std::vector<std::string>& arguments) const { return end_of(start(arguments)); }

  struct KilledCall {
    bool ended;  ///< before it could be killed
    int end;     ///< as end_of tells it
  };
  /// Kills the call after its first or second epoch, at each of the `starts` a little later.
  KilledCall killed_call(const std::vector<std::string>& arguments, long starts) const {
    const ::pid_t child = start(arguments);
    const long epochs = 1 + starts % 2;
    int status = 0;
    while (lines("out") < epochs) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (::waitpid(child, &status, WNOHANG) == child) return {true, end_of_status(status)};
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * starts % 17));
    ::kill(child, SIGKILL);
    return {false, end_of(child)};
  }

  std::string text(const char* name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  long lines(const char* name) const {
    const std::string all = text(name);
    return std::ranges::count(all, '\n');
  }

  static std::vector<std::string> training(const std::string& out) {
    return {"train", "ball.data", "--out",           out, "--set", "network.width=0.03125",
            "--set", "epochs=8",  "--progress-lines"};
  }

  fs::path folder_;
};

TEST_F(TrainProgram, KilledAtAnyMomentLosesAtMostAnEpochAndEndsInTheSameWeights) {
  ASSERT_EQ(call(training("whole.model")), 0) << text("err");
  const neural::Model whole = neural::read_model(folder_ / "whole.model");

  long done = 0, starts = 0;
  for (; done < 8 && starts < 60; ++starts) {
    const auto [ended, end] = killed_call(training("killed.model"), starts);
    ASSERT_TRUE(end == 0 || (!ended && end == -SIGKILL)) << end << text("err");
    if (ended) break;
    const std::string first = text("out").substr(0, text("out").find(" 8 "));
    ASSERT_TRUE(first.starts_with("epoch ")) << first;
    EXPECT_LE(std::stol(first.substr(6)), done + 2) << "an epoch was left out";
    EXPECT_GT(std::stol(first.substr(6)), done) << "a finished epoch was done again";
    done = std::stol(first.substr(6)) + lines("out") - 1;
  }
  EXPECT_GE(starts, 3);
  ASSERT_EQ(call(training("killed.model")), 0) << text("err");
  const neural::Model killed = neural::read_model(folder_ / "killed.model");
  EXPECT_EQ(killed.weights, whole.weights);
  EXPECT_EQ(killed.codebook, whole.codebook);
  EXPECT_TRUE(std::ranges::equal(killed.epochs, whole.epochs, {}, &neural::EpochRecord::loss,
                                 &neural::EpochRecord::loss));
}

TEST_F(TrainProgram, StopsWhenInterruptedAndSaysHowToGoOn) {
  auto arguments = training("ball.model");
  arguments[7] = "epochs=100000";
  const ::pid_t child = start(arguments);
  while (lines("out") < 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(child, SIGINT);
  EXPECT_EQ(end_of(child), 4);
  EXPECT_NE(text("err").find("the same command goes on"), std::string::npos) << text("err");
  EXPECT_TRUE(fs::exists(folder_ / "ball.model.checkpoints" / "training.checkpoint"));
  EXPECT_FALSE(fs::exists(folder_ / "ball.model"));
}

TEST_F(TrainProgram, EndsWithAProgramThatReadsItsLinesAndIsKilled) {
  auto arguments = training("ball.model");
  arguments[7] = "epochs=100000";
  int numbers[2];
  ASSERT_EQ(::pipe(numbers), 0);
  const ::pid_t reader = ::fork();
  if (reader == 0) {
    const ::pid_t trainer = start(arguments);
    if (::write(numbers[1], &trainer, sizeof trainer) != sizeof trainer) ::_exit(97);
    ::pause();
  }
  ::pid_t trainer = 0;
  ASSERT_EQ(::read(numbers[0], &trainer, sizeof trainer), sizeof trainer);
  for (const int end : numbers) ::close(end);
  while (lines("out") < 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(is_alive(trainer));
  ::kill(reader, SIGKILL);
  EXPECT_EQ(end_of(reader), -SIGKILL);
  EXPECT_TRUE(all_gone({trainer}));
  EXPECT_TRUE(fs::exists(folder_ / "ball.model.checkpoints" / "training.checkpoint"));
}

TEST_F(TrainProgram, StudyKilledAtAnyMomentGoesOnAndEndsInTheSameBytes) {
  const auto study = [](const std::string& out) -> std::vector<std::string> {
    return {"study-2d",   "--out", out,        "--side", "32",
            "--patterns", "8",     "--epochs", "4",      "--progress-lines"};
  };
  ASSERT_EQ(call(study("whole.data")), 0) << text("err");
  EXPECT_EQ(lines("out"), 12);

  long last = 0, starts = 0;
  for (; starts < 30 && !fs::exists(folder_ / "killed.data"); ++starts) {
    const auto [ended, end] = killed_call(study("killed.data"), starts);
    ASSERT_TRUE(end == 0 || (!ended && end == -SIGKILL)) << end << text("err");
    if (ended) break;
    const std::string out = text("out");
    ASSERT_TRUE(out.starts_with("epoch ")) << out;
    const long first = std::stol(out.substr(6));
    EXPECT_GT(first, last) << "the first epoch after a start was done again";
    last = first;
  }
  EXPECT_GE(starts, 3);
  ASSERT_EQ(call(study("killed.data")), 0) << text("err");
  EXPECT_EQ(text("killed.data"), text("whole.data"));
  EXPECT_FALSE(fs::exists(folder_ / "killed.data.checkpoints"));
}

TEST_F(TrainProgram, StudyStopsWhenInterruptedAndTellsTheTimeOfTheRest) {
  std::vector<std::string> arguments = {"study-2d", "--out",           "study.data", "--side",
                                        "32",       "--patterns",      "2",          "--epochs",
                                        "1000000",  "--progress-lines"};
  const ::pid_t child = start(arguments);
  while (lines("out") < 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(child, SIGINT);
  EXPECT_EQ(end_of(child), 4);
  EXPECT_NE(text("err").find("the same command goes on"), std::string::npos) << text("err");
  EXPECT_TRUE(fs::exists(folder_ / "study.data.checkpoints" / "labels" / "training.checkpoint"));
  EXPECT_FALSE(fs::exists(folder_ / "study.data"));

  arguments[8] = "3";
  arguments.emplace_back("--time");
  ASSERT_EQ(call(arguments), 0) << text("err");
  const std::string said = text("out");
  EXPECT_TRUE(said.starts_with("message ")) << said;
  EXPECT_NE(said.find("labels begin anew"), std::string::npos) << said;
  const auto at = said.find("\nseconds ");
  ASSERT_NE(at, std::string::npos) << said;
  EXPECT_GT(std::stod(said.substr(at + 9)), 0);
  EXPECT_FALSE(fs::exists(folder_ / "study.data")) << "it was made";
}

TEST_F(TrainProgram, AnswersBadInputWithExitCodeTwoAndLeavesNothing) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why) {
    EXPECT_EQ(call(arguments), 2) << why;
    EXPECT_NE(text("err").find(why), std::string::npos) << text("err");
    EXPECT_FALSE(fs::exists(folder_ / "x.model")) << why;
  };
  refused({"train", "nowhere.data", "--out", "x.model"}, "nowhere.data");
  refused({"train", "ball.data", "--out", "x.model", "--set", "network.resolutions=[64]"},
          "resolution 64");
  refused({"train", "ball.data", "--out", "x.model", "--set", "wdth=2"}, "wdth");
  refused({"train", "ball.data", "--out", "x.model", "--device", "abacus"}, "abacus");
  std::string bytes = text("ball.data");
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(folder_ / "changed.data", std::ios::binary) << bytes;
  refused({"train", "changed.data", "--out", "x.model"}, "changed.data");
  refused({"info", "changed.data"}, "changed.data");
  std::ofstream(folder_ / "short.data", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  refused({"train", "short.data", "--out", "x.model"}, "short.data");
}

}  // namespace
}  // namespace fracbench
