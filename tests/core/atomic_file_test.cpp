#include "core/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "core/error.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("fracbench_atomic_" + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::size_t files() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }
  static std::string message(const fs::path& file, std::string_view bytes) {
    try {
      write_file_atomically(file, bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_;
};

TEST_F(AtomicFile, HoldsTheBytesAndLeavesNothingElse) {
  std::string bytes(300000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * i >> 3);
  write_file_atomically(folder_ / "data", bytes);
  EXPECT_EQ(content(folder_ / "data"), bytes);
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, ReplacesAFileThatIsThere) {
  write_file_atomically(folder_ / "data", "a long first version");
  write_file_atomically(folder_ / "data", "second");
  EXPECT_EQ(content(folder_ / "data"), "second");
  write_file_atomically(folder_ / "data", "");
  EXPECT_EQ(content(folder_ / "data"), "");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, NamesTheMissingFolder) {
  const std::string text = message(folder_ / "missing" / "data", "x");
  EXPECT_THAT(text, HasSubstr((folder_ / "missing" / "data").string()));
  EXPECT_THAT(text, HasSubstr("No such file or directory"));
  EXPECT_THAT(text, HasSubstr("create it first"));
}

TEST_F(AtomicFile, DoesNotReplaceAFolder) {
  fs::create_directory(folder_ / "data");
  EXPECT_THAT(message(folder_ / "data", "x"), HasSubstr("Is a directory"));
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, ReportsAFullDevice) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string text = message("/dev/full", "x");
  EXPECT_THAT(text, HasSubstr("No space left on device"));
  EXPECT_THAT(text, HasSubstr("free some space"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(AtomicFile, ThatCannotBeWrittenLeavesTheOldOneAsItWas) {
  write_file_atomically(folder_ / "data", "old");
  const ::pid_t child = ::fork();
  if (child == 0) {
    // A limit on the size of files stands in for a full disk: the write stops half way.
    const ::rlimit limit = {4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    const std::string text = message(folder_ / "data", std::string(100000, 'x'));
    const bool right = text.find("File too large") != std::string::npos &&
                       text.find("100000 bytes") != std::string::npos;
    ::_exit(right ? 0 : 1);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(content(folder_ / "data"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, NeedsPermissionToWrite) {
  if (::geteuid() == 0) GTEST_SKIP() << "the superuser may write everywhere";
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THAT(message(folder_ / "data", "x"), HasSubstr("Permission denied"));
  fs::permissions(folder_, fs::perms::owner_all);
}

TEST_F(AtomicFile, ManyAppearTogether) {
  write_file_atomically(folder_ / "0", "old");
  fs::create_directory(folder_ / "below");
  AtomicFiles files;
  files.add(folder_ / "0", "new");
  files.add(folder_ / "below" / "1", "other");
  EXPECT_EQ(content(folder_ / "0"), "old");
  EXPECT_FALSE(fs::exists(folder_ / "below" / "1"));
  files.commit();
  EXPECT_EQ(content(folder_ / "0"), "new");
  EXPECT_EQ(content(folder_ / "below" / "1"), "other");
  EXPECT_EQ(this->files(), 2u);
}

TEST_F(AtomicFile, OfManyNothingIsLeftUnlessTheyAreCommitted) {
  {
    AtomicFiles files;
    for (int i = 0; i < 3; ++i) files.add(folder_ / std::to_string(i), "x");
    EXPECT_EQ(this->files(), 3u) << "under other names";
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(AtomicFile, AnErrorAmongManyNamesTheFileAndLeavesNothingHalf) {
  AtomicFiles files;
  EXPECT_THROW(files.add(folder_ / "missing" / "data", "x"), InputError);
  files.add(folder_ / "good", "x");
  files.add(folder_ / "data", "x");
  fs::create_directory(folder_ / "data");  // its name is taken when it wants to appear
  try {
    files.commit();
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr((folder_ / "data").string()));
  }
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_THAT(entry.path().extension(), "") << entry.path();
  }
}

TEST_F(AtomicFile, ManyFromManyThreadsAllArrive) {
  constexpr int each = 100;
  AtomicFiles files;
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < each; ++i) {
        const std::string name = std::to_string(t) + "_" + std::to_string(i);
        files.add(folder_ / name, name);
      }
    });
  }
  threads.clear();
  files.commit();
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_EQ(content(entry.path()), entry.path().filename().string());
  }
  EXPECT_EQ(this->files(), 4u * each);
}

}  // namespace
}  // namespace fracbench
