#include "core/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <thread>

#include "core/error.h"
#include "core/temporary_folder.h"

namespace fracbench {
namespace {

std::vector<std::string> shell(const std::string& script) { return {"sh", "-c", script}; }

TEST(ChildProcess, PassesLinesOnAndKeepsTheEndOfWhatWasSaid) {
  std::vector<std::string> lines;
  const ChildResult result =
      run_child(shell("echo one; echo two; echo careful >&2"),
                {.on_line = [&](std::string_view line) { lines.emplace_back(line); }});
  EXPECT_TRUE(result.good());
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(result.said, "careful");
}

TEST(ChildProcess, TellsHowItEnded) {
  EXPECT_EQ(run_child(shell("exit 3")).describe(), "with exit code 3");
  EXPECT_EQ(run_child(shell("kill -SEGV $$")).signal, SIGSEGV);
}

TEST(ChildProcess, KeepsOnlyTheEndOfAFlood) {
  const ChildResult result = run_child(shell("yes x | head -c 1000000 >&2; echo last >&2"));
  EXPECT_LE(result.said.size(), 2000u);
  EXPECT_TRUE(result.said.ends_with("last"));
}

TEST(ChildProcess, WorksInTheFolderThatItIsGiven) {
  const TemporaryWorkFolder folder("test");
  std::string where;
  run_child(shell("pwd -P"),
            {.folder = folder.path(), .on_line = [&](std::string_view line) { where = line; }});
  EXPECT_EQ(where, std::filesystem::canonical(folder.path()).string());
}

TEST(ChildProcess, ThatIsNotThereIsAnError) {
  EXPECT_THROW(run_child({"/no/such/program"}), std::system_error);
}

TEST(ChildProcess, EndsWithAllItsDescendantsWhenAskedToStop) {
  // The second one leaves the group of the first.
  const TemporaryWorkFolder folder("test");
  std::stop_source source;
  std::thread stopper([&] {
    while (!std::filesystem::exists(folder.path() / "pid")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    source.request_stop();
  });
  EXPECT_THROW(run_child(shell("setsid sh -c 'echo $$ > pid.new; mv pid.new pid; exec sleep 1000' "
                               "& wait"),
                         {.folder = folder.path(), .stop = source.get_token()}),
               Cancelled);
  stopper.join();
  pid_t grandchild = 0;
  std::ifstream(folder.path() / "pid") >> grandchild;
  ASSERT_GT(grandchild, 0);
  // Gone, or dead and not yet collected by the process that inherited it.
  for (int k = 0; k < 200; ++k) {
    std::ifstream stat("/proc/" + std::to_string(grandchild) + "/stat");
    std::string word;
    stat >> word >> word >> word;
    if (!stat || word == "Z") return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ADD_FAILURE() << "process " << grandchild << " is alive";
}

TEST(TemporaryWorkFolder, IsRemovedWithWhatIsInIt) {
  std::filesystem::path path;
  {
    const TemporaryWorkFolder folder("test");
    path = folder.path();
    std::ofstream(path / "file") << "x";
    EXPECT_TRUE(std::filesystem::exists(path / "file"));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace fracbench
