#include "harness/conformance/write_watch.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <map>
#include <thread>

#include "core/child_process.h"
#include "core/error.h"
#include "temporary_folder.h"

namespace fracbench::conformance {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class WriteWatch : public testing::Test {
 protected:
  void SetUp() override {
    const std::string why = watch_writes(allowed_.path(), [] {}).unseen;
    if (!why.empty()) GTEST_SKIP() << "nothing can be watched here: " << why;
    write(old_, "old");
    fs::create_directory(outside_.path() / "folder");
  }

  static void write(const fs::path& file, const std::string& text,
                    std::ios::openmode mode = std::ios::out) {
    std::ofstream(file, mode) << text;
  }
  static void run(const std::string& script) { run_child({"sh", "-c", script}); }

  /// Folders that no check hands out, and one that it does.
  TemporaryFolder outside_, allowed_;
  const fs::path old_ = outside_.path() / "old", new_ = outside_.path() / "new";
};

TEST_F(WriteWatch, SeesEveryWayToMakeAFile) {
  const fs::path inside = allowed_.path() / "link";
  fs::create_symlink(new_, inside);
  const std::map<std::string, std::function<void()>> ways = {
      {"write", [&] { write(new_, "x"); }},
      {"write in a thread", [&] { std::thread([&] { write(new_, "x"); }).join(); }},
      {"write in a program", [&] { run("echo x > " + new_.string()); }},
      {"write in a program that has left", [&] { run("setsid touch " + new_.string()); }},
      {"write by a relative name",
       [&] {
         fs::current_path(outside_.path() / "folder");
         write("../new", "x");
       }},
      {"write below an open folder",
       [&] {
         const int folder = ::open(outside_.path().c_str(), O_RDONLY | O_DIRECTORY);
         ::close(::openat(folder, "new", O_CREAT | O_WRONLY, 0600));
       }},
      {"write through a link", [&] { write(inside, "x"); }},
      {"map",
       [&] {
         const int file = ::open(new_.c_str(), O_CREAT | O_RDWR, 0600);
         ASSERT_EQ(::ftruncate(file, 100), 0);
         void* at = ::mmap(nullptr, 100, PROT_WRITE, MAP_SHARED, file, 0);
         *static_cast<char*>(at) = 'x';
       }},
      {"move",
       [&] {
         write(allowed_.path() / "new", "x");
         fs::rename(allowed_.path() / "new", new_);
       }},
      {"make a folder", [&] { fs::create_directory(new_); }},
      {"make a link", [&] { fs::create_symlink("nowhere", new_); }},
      {"make a hard link", [&] { ASSERT_EQ(::link(inside.c_str(), new_.c_str()), 0); }},
      {"make a pipe", [&] { ASSERT_EQ(::mkfifo(new_.c_str(), 0600), 0); }},
  };
  for (const auto& [name, way] : ways) {
    const WatchedWork watched = watch_writes(allowed_.path(), way);
    EXPECT_THAT(watched.changes, ElementsAre("leaves " + new_.string())) << name;
    EXPECT_EQ(watched.failure + watched.unseen, "") << name;
    fs::remove(new_);
  }
}

TEST_F(WriteWatch, SeesEveryWayToChangeAFile) {
  const std::map<std::string, std::function<void()>> ways = {
      {"write", [&] { write(old_, "new"); }},
      {"add", [&] { write(old_, "more", std::ios::app); }},
      {"cut", [&] { ASSERT_EQ(::truncate(old_.c_str(), 1), 0); }},
      {"move",
       [&] {
         write(allowed_.path() / "old", "x");
         fs::rename(allowed_.path() / "old", old_);
       }},
      {"hide the time", [&] {
         const auto time = fs::last_write_time(old_);
         write(old_, "new");
         fs::last_write_time(old_, time);
       }}};
  for (const auto& [name, way] : ways) {
    EXPECT_THAT(watch_writes(allowed_.path(), way).changes, ElementsAre("changes " + old_.string()))
        << name;
  }
}

TEST_F(WriteWatch, SeesWhatIsRemoved) {
  EXPECT_THAT(watch_writes(allowed_.path(), [&] { fs::rename(old_, new_); }).changes,
              ElementsAre("leaves " + new_.string(), "removes " + old_.string()));
  EXPECT_THAT(
      watch_writes(allowed_.path(), [&] { fs::remove_all(outside_.path()); }).changes,
      ElementsAre("removes " + outside_.path().string(),
                  "removes " + (outside_.path() / "folder").string(), "removes " + new_.string()));
}

TEST_F(WriteWatch, SaysNothingOfWhatIsAsItWas) {
  const WatchedWork watched = watch_writes(allowed_.path(), [&] {
    std::ifstream(old_).get();
    ::close(::open(old_.c_str(), O_RDWR));
    write(new_, "x");
    fs::remove(new_);
    write(allowed_.path() / "x", "x");
    write("/dev/null", "x");
    ASSERT_NE(std::tmpfile(), nullptr);
    ::mkdir(outside_.path().c_str(), 0700);
    run("mkdir -p " + outside_.path().string() + "; rm -f " + new_.string() +
        "; echo > /dev/stderr");
    std::ofstream("/proc/self/comm") << "another";
  });
  EXPECT_THAT(watched.changes, IsEmpty());
  EXPECT_EQ(watched.failure + watched.unseen, "");
}

TEST_F(WriteWatch, TellsWhatWasWrittenByWorkThatFails) {
  const std::map<std::string, std::function<void()>> ends = {
      {"a reason", [] { throw MethodFailure("a reason"); }},
      {"it ended by signal 9", [] { std::raise(SIGKILL); }},
      {"it ended with exit code 0", [] { std::_Exit(0); }}};
  for (const auto& [what, end] : ends) {
    const WatchedWork watched = watch_writes(allowed_.path(), [&] {
      write(new_, "x");
      end();
    });
    EXPECT_EQ(watched.failure, what);
    EXPECT_THAT(watched.changes, ElementsAre("leaves " + new_.string()));
    fs::remove(new_);
  }
  EXPECT_THROW(watch_writes(allowed_.path(), [] { throw InputError("no such option"); }),
               InputError);
}

TEST_F(WriteWatch, SaysWhereItSeesNothing) {
  // The system has one to ask for a process and its children.
  const WatchedWork watched = watch_writes(allowed_.path(), [&] {
    const WatchedWork inner = watch_writes(allowed_.path(), [&] { write(new_, "x"); });
    throw MethodFailure(inner.unseen);
  });
  EXPECT_THAT(watched.failure, HasSubstr("busy"));
  EXPECT_FALSE(fs::exists(new_)) << "work that cannot be watched is not done";
}

}  // namespace
}  // namespace fracbench::conformance
