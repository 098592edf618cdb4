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

TEST(Interrupt, WorkThatDoesNotNoticeItIsEndedWithinASecondAndLeavesNothing) {
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
  ASSERT_EQ(::kill(child, SIGINT), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
  // A busy machine may take longer than the second; the whole work takes some minutes.
  EXPECT_LT(Clock::now() - asked, std::chrono::seconds(10));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x"));
}

}  // namespace
}  // namespace fracbench
