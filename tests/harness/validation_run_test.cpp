#include "harness/validation_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <new>

#include "core/error.h"

namespace fracbench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Accuracy value(double expected, double computed, double tolerance = 0.01) {
  return {.name = "value",
          .reference = "closed form",
          .expected = expected,
          .computed = computed,
          .tolerance = tolerance};
}

ValidationCase gives(std::string name, std::vector<Accuracy> values) {
  return {
      .name = std::move(name), .summary = "a case", .run = [values](Context&) { return values; }};
}

ValidationCase throws(std::string name, std::function<void()> act) {
  return {.name = std::move(name),
          .summary = "a case",
          .run = [act](Context&) -> std::vector<Accuracy> {
            act();
            return {};
          }};
}

std::vector<std::string> names(const std::vector<ValidationCase>& cases) {
  std::vector<std::string> result;
  for (const ValidationCase& c : cases) result.push_back(c.name);
  return result;
}

TEST(ValidationRun, IsGoodWhereAllValuesAreWithinTheirTolerance) {
  const std::vector<ValidationCase> cases{gives("one", {value(2, 2.01), value(-3, -3.02)}),
                                          gives("two", {value(0, 0.005)})};
  const ValidationRun run = run_validation(cases, {});
  ASSERT_EQ(run.rows.size(), 3u);
  EXPECT_EQ(run.rows[1].group, "one");
  EXPECT_EQ(run.rows[2].group, "two");
  EXPECT_EQ(run.failed(), 0u);
  EXPECT_EQ(exit_code_of(run), ExitCode::good);
}

TEST(ValidationRun, AValueOutsideItsToleranceIsARegression) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double computed : {2.03, 1.97, -2.0, nan}) {
    const ValidationRun run =
        run_validation(std::vector{gives("one", {value(2, computed), value(1, 1)})}, {});
    EXPECT_EQ(run.failed(), 1u) << computed;
    EXPECT_EQ(exit_code_of(run), ExitCode::regression) << computed;
  }
}

TEST(ValidationRun, ACaseThatFailsIsARowWithItsReasonAndTheOthersGoOn) {
  const std::vector<ValidationCase> cases{
      throws("failure", [] { throw MethodFailure("the matrix is singular"); }),
      throws("mistake", [] { throw std::logic_error("a mistake"); }),
      throws("memory", [] { throw std::bad_alloc(); }), gives("nothing", {}),
      gives("good", {value(1, 1)})};
  const ValidationRun run = run_validation(cases, {});
  EXPECT_EQ(run.done, 5u);
  ASSERT_EQ(run.rows.size(), 5u);
  EXPECT_EQ(run.rows[0].failure, "the matrix is singular");
  EXPECT_EQ(run.rows[1].failure, "a mistake");
  EXPECT_THAT(run.rows[2].failure, HasSubstr("memory"));
  EXPECT_THAT(run.rows[3].failure, HasSubstr("no values"));
  EXPECT_EQ(run.failed(), 4u);
  EXPECT_EQ(exit_code_of(run), ExitCode::regression);
}

TEST(ValidationRun, ThatIsStoppedKeepsWhatWasDone) {
  std::stop_source source;
  const std::vector<ValidationCase> cases{gives("done", {value(1, 1)}),
                                          {.name = "stopped",
                                           .summary = "",
                                           .run =
                                               [&](Context& context) {
                                                 source.request_stop();
                                                 context.stop_if_asked();
                                                 return std::vector{value(1, 1)};
                                               }},
                                          gives("never", {value(1, 1)})};
  std::size_t kept = 0;
  const ValidationRun run =
      run_validation(cases, {.stop = source.get_token(),
                             .case_done = [&](const ValidationRun& r) { kept = r.rows.size(); }});
  EXPECT_TRUE(run.stopped);
  EXPECT_EQ(run.done, 1u);
  EXPECT_EQ(run.rows.size(), 1u);
  EXPECT_EQ(kept, 1u);
  EXPECT_EQ(exit_code_of(run), ExitCode::not_measured);
}

TEST(ValidationRun, TheRandomNumbersOfACaseDependOnSeedAndNameOnly) {
  const auto draw = [](const std::string& name) {
    return ValidationCase{.name = name, .summary = "", .run = [](Context& context) {
                            return std::vector{value(0, context.random.uniform())};
                          }};
  };
  const auto computed = [&](std::vector<ValidationCase> cases, std::uint64_t seed) {
    return run_validation(cases, {.seed = seed}).rows.back().accuracy.computed;
  };
  EXPECT_EQ(computed({draw("a"), draw("b")}, 1), computed({draw("b")}, 1));
  EXPECT_NE(computed({draw("b")}, 1), computed({draw("b")}, 2));
  EXPECT_NE(computed({draw("b")}, 1), computed({draw("a")}, 1));
}

TEST(ValidationRun, HandsThreadsOnAndShowsTheCaseThatRunsWithTheTimeLeft) {
  std::vector<RunProgress> shown;
  int threads = 0;
  std::vector<ValidationCase> cases{{.name = "first",
                                     .summary = "",
                                     .seconds = 10,
                                     .run =
                                         [&](Context& context) {
                                           threads = context.threads;
                                           return std::vector{value(1, 2)};
                                         }},
                                    gives("second", {value(1, 1)})};
  cases[1].seconds = 90;
  run_validation(cases,
                 {.threads = 3, .progress = [&](const RunProgress& p) { shown.push_back(p); }});
  EXPECT_EQ(threads, 3);
  ASSERT_EQ(shown.size(), 3u);
  EXPECT_THAT(shown[0].running, ElementsAre("first"));
  EXPECT_NEAR(shown[0].seconds_left.value(), 100, 1);
  // The first case took next to nothing: the second one is expected to as well.
  EXPECT_LT(shown[1].seconds_left.value(), 1);
  EXPECT_EQ(shown[1].failed, 1u);
  EXPECT_EQ(shown[2].done, 2u);
  EXPECT_THAT(shown[2].running, IsEmpty());
}

TEST(SelectCases, KeepsTheOrderOfTheMethodAndNamesTheNearestCase) {
  const std::vector<ValidationCase> cases{gives("penny-crack", {}), gives("sphere", {}),
                                          gives("beam", {})};
  EXPECT_THAT(names(select_cases(cases, {}, "toy")), ElementsAre("penny-crack", "sphere", "beam"));
  const std::vector<std::string> two{"beam", "penny-crack"};
  EXPECT_THAT(names(select_cases(cases, two, "toy")), ElementsAre("penny-crack", "beam"));
  const std::vector<std::string> wrong{"pennycrack"};
  try {
    select_cases(cases, wrong, "toy");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'penny-crack'"));
  }
}

}  // namespace
}  // namespace fracbench
