#include "harness/prepared_store.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

/// Keeps the number that its seed gave, and where it was made.
class Numbered : public Breakable {
 public:
  explicit Numbered(std::uint64_t value) : number(value) {}
  std::vector<Piece> fracture(const Impact&, Context&) const override { return {}; }
  void save(const fs::path& folder) const override {
    std::ofstream(folder / "number") << number;
    fs::create_directory(folder / "below");
    std::ofstream(folder / "below" / "more") << "more";
  }
  std::uint64_t number;
};

class Counting : public Method {
 public:
  MethodInfo info() const override {
    MethodInfo info;
    info.name = "counting";
    info.random = random;
    info.source_digest = digest;
    return info;
  }
  OptionsSchema options() const override {
    return {{.name = "file", .fallback = std::string(), .unit = "", .summary = ""},
            {.name = "x", .fallback = 1.0, .unit = "", .summary = ""}};
  }
  std::unique_ptr<Breakable> prepare(const Target&, const LearningData&, const Options&,
                                     Context& context) const override {
    ++made;
    checkpoints = context.checkpoints;
    if (!checkpoints.empty()) {
      EXPECT_TRUE(fs::is_directory(checkpoints));
      found_checkpoint = fs::exists(checkpoints / "half");
      std::ofstream(checkpoints / "half") << "done";
    }
    if (fails) throw MethodFailure("cannot");
    if (interrupted) throw Cancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    return std::make_unique<Numbered>(context.random.bits());
  }
  std::unique_ptr<Breakable> load(const fs::path& folder, const Target&,
                                  const Options&) const override {
    std::uint64_t number = 0;
    if (!(std::ifstream(folder / "number") >> number)) throw InputError("no number");
    return std::make_unique<Numbered>(number);
  }
  std::vector<fs::path> files(const Options& options) const override {
    if (options.text("file").empty()) return {};
    return {options.text("file")};
  }

  std::string digest = "1";
  bool random = true, fails = false, interrupted = false;
  int milliseconds = 0;
  mutable std::atomic<int> made = 0;
  mutable fs::path checkpoints;
  mutable bool found_checkpoint = false;
};

class PreparedStoreTest : public ::testing::Test {
 protected:
  PreparedStoreTest() { fs::remove_all(folder_); }
  ~PreparedStoreTest() override { fs::remove_all(folder_); }

  PreparedBody get(std::uint64_t seed = 1) {
    Random random(seed);
    StageTimer timer;
    Progress progress;
    Context context{.random = random, .timer = timer, .progress = progress};
    return store_.get({.method = method_, .options = options_, .target = target_}, context);
  }
  static std::uint64_t number(const PreparedBody& body) {
    return dynamic_cast<const Numbered&>(*body.body).number;
  }
  fs::path only_entry() const {
    const auto list = store_.list();
    EXPECT_EQ(list.size(), 1u);
    return folder_ / "prepared" / list.at(0).key;
  }
  static void overwrite(const fs::path& file, const std::string& text) {
    std::ofstream(file) << text;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("store-" + std::to_string(::getpid()));
  PreparedStore store_{folder_};
  Counting method_;
  Target target_{.name = "box", .mesh = box_mesh({0, 0, 0}, {1, 1, 1}), .material = {}};
  Options options_{method_.options(), {}, "test"};
};

TEST_F(PreparedStoreTest, MakesABodyOnce) {
  const PreparedBody first = get();
  const PreparedBody second = get();
  EXPECT_EQ(method_.made, 1);
  EXPECT_EQ(number(first), number(second));
  EXPECT_EQ(first.seconds, second.seconds);
  EXPECT_FALSE(fs::exists(method_.checkpoints));
  const auto list = store_.list(true);
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].method, "counting");
  EXPECT_EQ(list[0].shape, "box");
  EXPECT_EQ(list[0].complaint, "");
  EXPECT_TRUE(store_.remove(list[0].key));
  EXPECT_FALSE(store_.remove(list[0].key));
  EXPECT_TRUE(store_.list().empty());
}

TEST_F(PreparedStoreTest, MakesAnotherOneForWhateverDeterminesIt) {
  const std::uint64_t one = number(get());
  EXPECT_NE(number(get(2)), one);
  int made = 2;
  const auto expect_made = [&](const char* what) {
    get();
    EXPECT_EQ(method_.made, ++made) << what;
  };
  target_.material.toughness *= 2;
  expect_made("material");
  target_.mesh = box_mesh({0, 0, 0}, {1, 1, 2});
  expect_made("mesh");
  options_ = Options(method_.options(), {{"x", 2.0}}, "test");
  expect_made("option");
  method_.digest = "2";
  expect_made("sources");
  const fs::path file = folder_ / "model";
  options_ = Options(method_.options(), {{"file", file.string()}}, "test");
  overwrite(file, "a");
  expect_made("file");
  overwrite(file, "b");
  expect_made("content of the file");
  get();
  EXPECT_EQ(method_.made, made);
  method_.random = false;
  expect_made("not random");
  get(17);
  EXPECT_EQ(method_.made, made) << "the seed of a method that is not random";
  fs::remove(file);
  EXPECT_THROW(get(), InputError);
}

TEST_F(PreparedStoreTest, WhatLearnsSeveralShapesIsOneForAllOfThem) {
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress};
  const Target other{.name = "slab", .mesh = box_mesh({0, 0, 0}, {1, 1, 3}), .material = {}};
  const auto number_for = [&](const Target& target, const std::string& own,
                              std::vector<std::string> further) {
    return number(store_.get({.method = method_,
                              .options = options_,
                              .target = target,
                              .learning_digest = own,
                              .further_digests = std::move(further)},
                             context));
  };
  const std::uint64_t one = number_for(target_, "of box", {"of slab"});
  EXPECT_EQ(number_for(other, "of slab", {"of box"}), one);
  EXPECT_EQ(method_.made, 1);
  number_for(other, "of slab", {"of cube"});
  EXPECT_EQ(method_.made, 2);
  number_for(other, "of slab", {});
  EXPECT_EQ(method_.made, 3);
}

TEST_F(PreparedStoreTest, DamagedEntriesAreMadeAnew) {
  const std::uint64_t good = number(get());
  const fs::path entry = only_entry();
  int made = 1;
  const auto damage = [&](const fs::path& file, const std::string& text) {
    overwrite(file, text);
    EXPECT_NE(store_.list(true).at(0).complaint, "");
    EXPECT_EQ(number(get()), good) << file;
    EXPECT_EQ(method_.made, ++made) << file;
    EXPECT_TRUE(fs::exists(entry.string() + ".damaged"));
    EXPECT_EQ(store_.list(true).at(0).complaint, "");
  };
  damage(entry / "number", "7");
  damage(entry / "number", "");
  damage(entry / "below" / "more", "mort");
  damage(entry / "manifest.json", "{");
  damage(entry / "manifest.json", R"({"method":1})");
  fs::remove(entry / "below" / "more");
  EXPECT_EQ(number(get()), good);
  EXPECT_EQ(method_.made, ++made);
}

TEST_F(PreparedStoreTest, CheckPointsOutliveAnInterruption) {
  method_.interrupted = true;
  EXPECT_THROW(get(), Cancelled);
  EXPECT_FALSE(method_.found_checkpoint);
  EXPECT_TRUE(store_.list().empty());
  method_.interrupted = false;
  get();
  EXPECT_TRUE(method_.found_checkpoint);
}

TEST_F(PreparedStoreTest, KeepsNothingOfWhatAMethodCannotDo) {
  method_.fails = true;
  EXPECT_THROW(get(), MethodFailure);
  EXPECT_TRUE(store_.list().empty());
}

TEST_F(PreparedStoreTest, SeveralThatWantOneBodyMakeItOnce) {
  method_.milliseconds = 200;
  std::vector<std::thread> threads;
  std::atomic<int> good = 0;
  for (int n = 0; n < 4; ++n) {
    threads.emplace_back([&] { good += get().body != nullptr; });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, 4);
  EXPECT_EQ(method_.made, 1);
}

// A process that is killed while it makes a body leaves a lock that nobody holds.
TEST_F(PreparedStoreTest, AProcessThatWasKilledDoesNotBlockTheOthers) {
  const pid_t child = ::fork();
  if (child == 0) {
    method_.milliseconds = 60000;
    get();
    ::_exit(0);
  }
  while (!fs::exists(folder_ / "prepared") || fs::is_empty(folder_ / "prepared")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NE(get().body, nullptr);
  EXPECT_TRUE(method_.found_checkpoint);
}

TEST_F(PreparedStoreTest, WorksWithoutAFolderThatCanBeWritten) {
  overwrite(folder_, "a file where the folder should be");
  EXPECT_NE(get().body, nullptr);
  EXPECT_NE(get().body, nullptr);
  EXPECT_EQ(method_.made, 2);
}

TEST(PreparedStore, LiesWhereTheEnvironmentSays) {
  const auto folder_with = [](const char* name, const char* cache) {
    ::setenv("FRACBENCH_CACHE", name, 1);
    ::setenv("XDG_CACHE_HOME", cache, 1);
    const auto store = PreparedStore::of_user();
    return store ? store->folder().string() : "none";
  };
  const char* before = std::getenv("FRACBENCH_CACHE");
  const std::string saved = before ? before : "";
  EXPECT_EQ(folder_with("/a/b", "/c"), "/a/b");
  EXPECT_EQ(folder_with("", "/c"), "none");
  ::unsetenv("FRACBENCH_CACHE");
  EXPECT_EQ(PreparedStore::of_user()->folder(), "/c/fracbench");
  ::unsetenv("XDG_CACHE_HOME");
  ::setenv("FRACBENCH_CACHE", saved.c_str(), 1);
}

}  // namespace
}  // namespace fracbench
