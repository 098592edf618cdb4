#include "harness/terminal_progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "harness/cost_model.h"

namespace fracbench {
namespace {

const RunProgress kHalf{.cells = 40,
                        .done = 20,
                        .found = 3,
                        .failed = 2,
                        .seconds = 10,
                        .seconds_left = 79.5,
                        .running = {"pot single-3 cvd: cut 40 %"}};

TEST(TerminalProgressTest, SaysHowMuchIsDoneAndLeft) {
  EXPECT_EQ(describe(kHalf), "[20/40] 50 %, 2 failed, 1 min 20 s left; pot single-3 cvd: cut 40 %");
}

TEST(TerminalProgressTest, KeepsToOneLineOfTheTerminal) {
  std::ostringstream out;
  {
    TerminalProgress progress(out, true, 20);
    progress.update(kHalf);
    progress.update(kHalf);
  }
  EXPECT_EQ(out.str(), "\r[20/40] 50 %, 2 fai\x1b[K\r[20/40] 50 %, 2 fai\x1b[K\n");
}

TEST(TerminalProgressTest, MessagesStayAboveTheLine) {
  std::ostringstream out;
  {
    TerminalProgress progress(out, true, 8);
    progress.update(kHalf);
    progress.message("a record is damaged");
  }
  EXPECT_EQ(out.str(), "\r[20/40]\x1b[K\r\x1b[Ka record is damaged\n");
}

TEST(TerminalProgressTest, WritesFewPlainLinesWhereThereIsNoTerminal) {
  std::ostringstream out;
  TerminalProgress progress(out, false);
  for (int i = 0; i < 100; ++i) progress.update(kHalf);
  EXPECT_EQ(out.str(), "");
  RunProgress end = kHalf;
  end.done = 40;
  end.running.clear();
  for (int i = 0; i < 100; ++i) progress.update(end);
  EXPECT_EQ(out.str(), "[40/40] 100 %, 2 failed\n");
}

TEST(TerminalProgressTest, SpeaksOfTimesAsPeopleDo) {
  EXPECT_EQ(describe_seconds(0.2), "1 s");
  EXPECT_EQ(describe_seconds(59), "59 s");
  EXPECT_EQ(describe_seconds(3599), "59 min 59 s");
  EXPECT_EQ(describe_seconds(7500), "2 h 5 min");
  EXPECT_EQ(describe_seconds(90000), "1 day 1 h");
  EXPECT_EQ(describe_seconds(274000), "3 days 4 h");
  EXPECT_EQ(describe_seconds(1e300), "an unknown time");
}

TEST(CostModelTest, PrefersTheSameShapeAndFallsBackToTheSameMethod) {
  CostModel model;
  EXPECT_FALSE(model.seconds("pot", "cvd", 1));
  model.add("pot", "cvd", 1, {});
  model.add("pot", "cvd", 3, {});
  model.add("mug", "cvd", 8, {});
  EXPECT_EQ(model.seconds("pot", "cvd", 1), 2);
  EXPECT_EQ(model.seconds("pot", "cvd", 10), 20);
  EXPECT_EQ(model.seconds("bar", "cvd", 2), 8);
  EXPECT_FALSE(model.seconds("pot", "bem", 1));
}

// A training of an hour in the first of forty cells does not make forty hours.
TEST(CostModelTest, TakesABodyOnceForEachShape) {
  CostModel model;
  const std::vector<StageTime> trained{{"prepare", 3600}, {"prediction", 1}},
      loaded{{"prepare", 1}, {"prediction", 1}};
  model.add("pot", "deepfracture", 3602, trained);
  model.add("pot", "deepfracture", 5, loaded);
  EXPECT_EQ(model.seconds("pot", "deepfracture", 40), 40 * 3);
  EXPECT_EQ(model.seconds("mug", "deepfracture", 40), 3600 + 40 * 3);
  EXPECT_EQ(model.seconds("mug", "deepfracture", 0), 0);
}

}  // namespace
}  // namespace fracbench
