#include "harness/conformance.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <vector>

#include "core/error.h"
#include "harness/conformance/write_watch.h"
#include "methods/cvd/cvd.h"
#include "methods/plane-cutter/plane_cutter.h"
#include "scenarios/shapes.h"
#include "temporary_folder.h"

namespace fracbench {
namespace {

/// A sound method, but for one thing.
class Spoiled : public Method {
 public:
  enum class By {
    nothing,
    remembering,
    losing_what_it_saves,
    not_stopping,
    leaking,
    littering,
    writing_elsewhere
  };
  explicit Spoiled(By by, std::filesystem::path elsewhere = {})
      : by_(by), elsewhere_(std::move(elsewhere)) {}

  MethodInfo info() const override { return sound_.info(); }
  OptionsSchema options() const override { return sound_.options(); }

  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                     const Options& options, Context& context) const override {
    return std::make_unique<Body>(sound_.prepare(target, learning, options, context), by_,
                                  elsewhere_);
  }
  std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                  const Options& options) const override {
    OptionMap values = options.values();
    if (by_ == By::losing_what_it_saves) values["sites"] = std::int64_t{3};
    return std::make_unique<Body>(
        sound_.load(folder, target, Options(sound_.options(), values, "test")), by_, elsewhere_);
  }

 private:
  class Body : public Breakable {
   public:
    Body(std::unique_ptr<Breakable> sound, By by, std::filesystem::path elsewhere)
        : sound_(std::move(sound)), by_(by), elsewhere_(std::move(elsewhere)) {}

    std::vector<Piece> fracture(const Impact& impact, Context& context) const override {
      if (by_ == By::not_stopping) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(1500);
        while (context.stop.stop_possible() && std::chrono::steady_clock::now() < end) {
        }
      }
      if (by_ == By::leaking) leaked_.emplace_back(100'000);
      if (by_ == By::littering) std::ofstream("cache.txt") << "an answer";
      if (by_ == By::writing_elsewhere) std::ofstream(elsewhere_) << "an answer";
      if (by_ != By::remembering) return sound_->fracture(impact, context);
      const std::scoped_lock lock(mutex_);
      if (!first_) first_ = sound_->fracture(impact, context);
      return *first_;
    }
    void save(const std::filesystem::path& folder) const override { sound_->save(folder); }

   private:
    std::unique_ptr<Breakable> sound_;
    By by_;
    std::filesystem::path elsewhere_;
    mutable std::mutex mutex_;
    mutable std::vector<std::vector<char>> leaked_;
    mutable std::optional<std::vector<Piece>> first_;
  };

  CvdMethod sound_;
  By by_;
  std::filesystem::path elsewhere_;
};

CheckResult result(Spoiled::By by, const std::string& check,
                   const std::filesystem::path& elsewhere = {}) {
  const Spoiled method(by, elsewhere);
  const Target target{.name = "cube", .mesh = load_shape({.name = "cube"}).mesh, .material = {}};
  return make_check(
      check,
      {.method = method, .options = Options(method.options(), {}, "test"), .target = target});
}

TEST(Conformance, OfASoundMethodPassesEveryCheck) {
  for (const Check& check : conformance_checks()) {
    const CheckResult found = result(Spoiled::By::nothing, check.name);
    if (check.name == "confined" && found.conformity == Conformity::skipped) continue;
    EXPECT_EQ(found.conformity, Conformity::passed) << check.name << ": " << found.detail;
    EXPECT_FALSE(check.summary.empty());
  }
}

TEST(Conformance, OfTheTemplateForNewMethodsIsGiven) {
  const PlaneCutterMethod method;
  for (const char* shape : {"cube", "mug"}) {
    const Target target{.name = shape, .mesh = load_shape({.name = shape}).mesh, .material = {}};
    for (const Check& check : conformance_checks()) {
      const CheckResult found = make_check(
          check.name,
          {.method = method, .options = Options(method.options(), {}, "test"), .target = target});
      if (check.name == "confined" && found.conformity == Conformity::skipped) continue;
      EXPECT_EQ(found.conformity, Conformity::passed) << shape << check.name << found.detail;
    }
  }
}

TEST(Conformance, FindsAnswersThatAreRememberedFromAnEarlierImpact) {
  const CheckResult found = result(Spoiled::By::remembering, "other-impact");
  EXPECT_EQ(found.conformity, Conformity::failed);
  EXPECT_NE(found.detail.find("that one's answer again"), std::string::npos) << found.detail;
  EXPECT_EQ(result(Spoiled::By::remembering, "other-seed").conformity, Conformity::failed);
  EXPECT_EQ(result(Spoiled::By::remembering, "same-seed").conformity, Conformity::passed);
}

TEST(Conformance, FindsWhatIsLostBetweenSavingAndLoading) {
  EXPECT_EQ(result(Spoiled::By::losing_what_it_saves, "save-load").conformity, Conformity::failed);
}

TEST(Conformance, FindsWorkThatDoesNotStop) {
  const CheckResult found = result(Spoiled::By::not_stopping, "cancel");
  EXPECT_EQ(found.conformity, Conformity::failed) << found.detail;
}

TEST(Conformance, FindsMemoryThatIsNotGivenBackAndTooMuchOfIt) {
  const CheckResult leak = result(Spoiled::By::leaking, "memory");
  EXPECT_EQ(leak.conformity, Conformity::failed);
  EXPECT_NE(leak.detail.find("leaves 98 KiB"), std::string::npos) << leak.detail;
  const CvdMethod method;
  const Target target{.name = "cube", .mesh = load_shape({.name = "cube"}).mesh, .material = {}};
  const CheckResult much = make_check("memory", {.method = method,
                                                 .options = Options(method.options(), {}, "test"),
                                                 .target = target,
                                                 .memory_mb = 1});
  EXPECT_EQ(much.conformity, Conformity::failed) << much.detail;
}

TEST(Conformance, FindsFilesThatAreLeftBehind) {
  const auto before = std::filesystem::current_path();
  const CheckResult found = result(Spoiled::By::littering, "tidy");
  EXPECT_EQ(found.conformity, Conformity::failed);
  EXPECT_EQ(found.detail, "it leaves cache.txt in current");
  EXPECT_EQ(std::filesystem::current_path(), before);
}

TEST(Conformance, FindsFilesThatAreWrittenElsewhereByThatCheckAlone) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "answers";
  for (const Check& check : conformance_checks()) {
    const CheckResult found = result(Spoiled::By::writing_elsewhere, check.name, file);
    if (check.name == "confined" && found.conformity == Conformity::skipped) continue;
    EXPECT_EQ(found.conformity == Conformity::failed, check.name == "confined")
        << check.name << ": " << found.detail;
    if (check.name == "confined") {
      EXPECT_EQ(found.detail, "it leaves " + file.string());
    }
  }
}

TEST(Conformance, IsSkippedWhereWhatIsWrittenCannotBeSeen) {
  const TemporaryFolder folder;
  // A process that is watched already cannot be watched a second time.
  const auto watched = conformance::watch_writes(folder.path(), [&] {
    const CheckResult found = result(Spoiled::By::nothing, "confined");
    throw MethodFailure(fmt::format("{}: {}", to_string(found.conformity), found.detail));
  });
  if (!watched.unseen.empty()) GTEST_SKIP() << watched.unseen;
  EXPECT_EQ(watched.failure.rfind("skipped: what it writes cannot be seen here: ", 0), 0u)
      << watched.failure;
}

TEST(Conformance, AnUnknownCheckIsRefusedWithTheNearest) {
  try {
    result(Spoiled::By::nothing, "volumes");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'volume'"), std::string::npos);
  }
}

}  // namespace
}  // namespace fracbench
