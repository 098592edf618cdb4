#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tests/app/program.h"

namespace fracbench {
namespace {

using Clock = std::chrono::steady_clock;

TEST(Interrupt, WorkThatDoesNotNoticeItIsEndedWithinASecondAndLeavesNothing) {
  const TemporaryFolder folder;
  const ::pid_t child = ::fork();
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
    if (::chdir(folder.path().c_str()) != 0) ::_exit(99);
    ::execl(FRACBENCH_PROGRAM, FRACBENCH_PROGRAM, "fracture", "cvd", "sphere", "--ball",
            "3,0,0,-60,0,0", "--set", "sites=5000", "--out", "x", nullptr);
    ::_exit(98);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const auto asked = Clock::now();
  ASSERT_EQ(::kill(child, SIGINT), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - asked).count(), 1.5);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x"));
}

}  // namespace
}  // namespace fracbench
