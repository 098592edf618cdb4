#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include "tests/app/program.h"
#include "tests/core/best_time.h"

namespace fracbench {
namespace {

using Clock = std::chrono::steady_clock;

/// Whether the process has got as far as that: it blocks them, and a thread of it waits for them.
bool handles_interrupts(::pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    if (word != "SigBlk:") continue;
    status >> word;
    return std::stoull(word, nullptr, 16) >> (SIGINT - 1) & 1;
  }
  return false;
}

/// The time from the interrupt to the end of work that would take minutes.
Clock::duration interrupted_work() {
  const TemporaryFolder folder;
  const ::pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
    if (::chdir(folder.path().c_str()) != 0) ::_exit(99);
    ::execl(FRACBENCH_PROGRAM, FRACBENCH_PROGRAM, "fracture", "cvd", "sphere", "--ball",
            "3,0,0,-60,0,0", "--set", "sites=10000", "--out", "x", nullptr);
    ::_exit(98);
  }
  for (int k = 0; k < 10000 && !handles_interrupts(child); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto asked = Clock::now();
  EXPECT_EQ(::kill(child, SIGINT), 0);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  const auto ended = Clock::now();
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x"));
  return ended - asked;
}

TEST(Interrupt, WorkThatDoesNotNoticeItIsEndedWithinASecondAndLeavesNothing) {
  constexpr std::chrono::milliseconds kLimit(1500);
  EXPECT_LT(best_time(kLimit, interrupted_work), kLimit);
}

}  // namespace
}  // namespace fracbench
