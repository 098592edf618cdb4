#include "core/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <thread>

#include "core/error.h"
#include "core/temporary_folder.h"
#include "tests/core/processes.h"

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
  EXPECT_TRUE(all_gone({grandchild}));
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

/// A folder that a process made which was killed.
std::filesystem::path abandoned_folder() {
  const std::filesystem::path place = std::filesystem::temp_directory_path();
  std::array<int, 2> ends{};
  EXPECT_EQ(::pipe(ends.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const TemporaryWorkFolder folder("killed");
    const std::string name = folder.path().filename().string();
    if (::write(ends[1], name.data(), name.size()) > 0) ::raise(SIGKILL);
  }
  ::close(ends[1]);
  std::array<char, 200> name{};
  EXPECT_GT(::read(ends[0], name.data(), name.size() - 1), 0);
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return place / name.data();
}

TEST(TemporaryWorkFolder, IsRemovedLaterWhereItsProcessWasKilled) {
  namespace fs = std::filesystem;
  const auto make_old = [](const fs::path& path) {
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(1));
  };
  const TemporaryWorkFolder in_use("test");
  const fs::path abandoned = abandoned_folder();
  ASSERT_TRUE(fs::exists(abandoned));
  make_old(in_use.path());
  remove_abandoned_work_folders();
  EXPECT_TRUE(fs::exists(abandoned)) << "it may be of a process that is about to lock it";
  std::ofstream(abandoned / "file") << "x";
  make_old(abandoned);
  remove_abandoned_work_folders();
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(in_use.path()));
}

}  // namespace
}  // namespace fracbench
