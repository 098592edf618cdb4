#include "harness/conformance.h"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <optional>

#include "core/error.h"
#include "methods/cvd/cvd.h"
#include "methods/plane-cutter/plane_cutter.h"
#include "scenarios/shapes.h"

namespace fracbench {
namespace {

/// A sound method, but for one thing.
class Spoiled : public Method {
 public:
  enum class By { nothing, remembering, losing_what_it_saves, not_stopping };
  explicit Spoiled(By by) : by_(by) {}

  MethodInfo info() const override { return sound_.info(); }
  OptionsSchema options() const override { return sound_.options(); }

  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                     const Options& options, Context& context) const override {
    return std::make_unique<Body>(sound_.prepare(target, learning, options, context), by_);
  }
  std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                  const Options& options) const override {
    OptionMap values = options.values();
    if (by_ == By::losing_what_it_saves) values["sites"] = std::int64_t{3};
    return std::make_unique<Body>(
        sound_.load(folder, target, Options(sound_.options(), values, "test")), by_);
  }

 private:
  class Body : public Breakable {
   public:
    Body(std::unique_ptr<Breakable> sound, By by) : sound_(std::move(sound)), by_(by) {}

    std::vector<Piece> fracture(const Impact& impact, Context& context) const override {
      if (by_ == By::not_stopping) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(1500);
        while (context.stop.stop_possible() && std::chrono::steady_clock::now() < end) {
        }
      }
      if (by_ != By::remembering) return sound_->fracture(impact, context);
      const std::scoped_lock lock(mutex_);
      if (!first_) first_ = sound_->fracture(impact, context);
      return *first_;
    }
    void save(const std::filesystem::path& folder) const override { sound_->save(folder); }

   private:
    std::unique_ptr<Breakable> sound_;
    By by_;
    mutable std::mutex mutex_;
    mutable std::optional<std::vector<Piece>> first_;
  };

  CvdMethod sound_;
  By by_;
};

CheckResult result(Spoiled::By by, const std::string& check) {
  const Spoiled method(by);
  const Target target{.name = "cube", .mesh = load_shape({.name = "cube"}).mesh, .material = {}};
  return make_check(
      check,
      {.method = method, .options = Options(method.options(), {}, "test"), .target = target});
}

TEST(Conformance, OfASoundMethodPassesEveryCheck) {
  for (const Check& check : conformance_checks()) {
    const CheckResult found = result(Spoiled::By::nothing, check.name);
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
