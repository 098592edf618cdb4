#include "harness/suite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "harness/suite_files.h"
#include "harness/suite_overrides.h"
#include "harness/suite_reader.h"
#include "temporary_folder.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class SuiteTest : public testing::Test {
 protected:
  ToyWorld world;
  Catalog catalog = world.catalog();

  /// The message with which the toy suite is refused after `from` was replaced by `to`.
  std::string message(const std::string& from, const std::string& to) {
    std::string text = toy_suite_text();
    text.replace(text.find(from), from.size(), to);
    return message_of([&] { parse_suite(text, "toy.toml", catalog); });
  }

  std::string set_message(const std::string& assignment) {
    return message_of([&] { with_override(toy_suite(catalog), assignment, catalog); });
  }

  template <typename Call>
  static std::string message_of(const Call& call) {
    try {
      call();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no InputError";
  }
};

TEST_F(SuiteTest, HoldsWhatTheFileSaysAndDefaultsForTheRest) {
  const Suite suite = toy_suite(catalog);
  EXPECT_EQ(suite.name, "toy");
  EXPECT_EQ(suite.seed, 5);
  EXPECT_EQ(suite.repeats, 1);
  ASSERT_EQ(suite.shapes.size(), 2);
  EXPECT_EQ(suite.shapes[0].request.longest_side, 1.9);
  EXPECT_EQ(suite.shapes[1].request.longest_side, 1.5);
  ASSERT_EQ(suite.methods.size(), 2);
  EXPECT_EQ(suite.methods[0].options.number("margin"), 0.1);
  EXPECT_EQ(suite.methods[1].label, "halves-wide");
  EXPECT_EQ(suite.scenarios.at(0).options.number("speed"), 40);
}

TEST_F(SuiteTest, NamesTheLineAndTheNearestKeyForAnUnknownOne) {
  EXPECT_THAT(message("margin", "margni"),
              AllOf(HasSubstr("toy.toml:20"), HasSubstr("did you mean 'margin'?")));
  EXPECT_THAT(message("seed", "sead"), AllOf(HasSubstr("toy.toml:3"), HasSubstr("'seed'")));
  EXPECT_THAT(message("longest_side", "longest"), HasSubstr("toy.toml:8"));
  EXPECT_THAT(message("\"shove\"", "\"shov\""), HasSubstr("did you mean 'shove'?"));
  EXPECT_THAT(message("\"halves\"", "\"halvse\""), HasSubstr("did you mean 'halves'?"));
}

TEST_F(SuiteTest, NamesUnitAndRangeForAValueThatIsOutOfRange) {
  EXPECT_THAT(message("speed = 40", "speed = 400"),
              AllOf(HasSubstr("toy.toml:12"), HasSubstr("400 m/s"), HasSubstr("1 to 100 m/s")));
  EXPECT_THAT(message("margin = 0.2", "margin = nan"), HasSubstr("nan m"));
  EXPECT_THAT(message("seed = 5", "repeats = 0"), HasSubstr("repeats"));
  EXPECT_THAT(message("longest_side = 1.5", "longest_side = -1"), HasSubstr("-1 m"));
}

TEST_F(SuiteTest, RefusesWrongTypesAndBrokenFiles) {
  EXPECT_THAT(message("seed = 5", "seed = \"five\""), HasSubstr("whole number"));
  EXPECT_THAT(message("margin = 0.2", "margin = [\"a\"]"), HasSubstr("only numbers"));
  EXPECT_THAT(message("margin = 0.2", "margin = 1979-05-27"), HasSubstr("toy.toml:20"));
  EXPECT_THAT(message("shapes = [\"box\"]", "shapes = \"box\""), HasSubstr("list of names"));
  EXPECT_THAT(message("[[method]]", "[method]"), HasSubstr("toy.toml:"));
  EXPECT_THAT(message("seed = 5", "seed ="), HasSubstr("toy.toml:3"));
  EXPECT_THAT(message("seed = 5", std::string("seed = 5\0\1", 10)), HasSubstr("toy.toml:3"));
  EXPECT_THAT(message("family = \"shove\"\n", ""), HasSubstr("'family' is missing"));
  EXPECT_THAT(message_of([&] { parse_suite("", "toy.toml", catalog); }),
              HasSubstr("the suite has no shape"));
}

TEST_F(SuiteTest, RefusesLabelsThatAreUsedTwiceOrWouldNotFitAFileName) {
  EXPECT_THAT(message("label = \"halves-wide\"\n", ""), HasSubstr("are called 'halves'"));
  EXPECT_THAT(message("halves-wide", "halves/wide"), HasSubstr("may hold only"));
}

TEST_F(SuiteTest, AMethodMayNameTheShapesThatItBreaks) {
  std::string text = toy_suite_text();
  text.insert(text.find("label = \"halves-wide\""), "shapes = [\"slab\"]\n");
  const Suite suite = parse_suite(text, "toy.toml", catalog);
  EXPECT_TRUE(suite.methods[1].breaks("slab"));
  EXPECT_FALSE(suite.methods[1].breaks("box"));
  EXPECT_TRUE(suite.methods[0].breaks("box"));
  EXPECT_NE(to_json(suite), to_json(toy_suite(catalog)));
  EXPECT_THAT(message("label = \"halves-wide\"", "label = \"halves-wide\"\nshapes = [\"slub\"]"),
              AllOf(HasSubstr("halves-wide"), HasSubstr("did you mean 'slab'?")));
  EXPECT_THAT(message("label = \"halves-wide\"", "label = \"halves-wide\"\nshapes = \"slab\""),
              HasSubstr("list of names"));
}

TEST_F(SuiteTest, FindsFilesBesideItself) {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  std::ofstream(folder / "rock.obj") << "\n";
  std::string text = toy_suite_text();
  text.replace(text.find("\"box\""), 5, "\"rock.obj\"");
  const Suite suite = parse_suite(text, folder / "toy.toml", catalog);
  EXPECT_EQ(suite.shapes[0].label, "rock");
  EXPECT_EQ(find_suite_input(suite, suite.shapes[0].request.name), folder / "rock.obj");
  EXPECT_EQ(find_suite_input(suite, "elsewhere.obj"), "elsewhere.obj");
}

TEST_F(SuiteTest, FindsFilesInTheUsersFolderOfShapes) {
  setenv("FRACBENCH_SHAPES", "/shapes", 1);
  EXPECT_EQ(find_suite_input(Suite{}, "$FRACBENCH_SHAPES/runs/a.csv"), "/shapes/runs/a.csv");
  unsetenv("FRACBENCH_SHAPES");
}

TEST_F(SuiteTest, OverridesReplaceSingleValues) {
  Suite suite = toy_suite(catalog);
  for (const char* assignment : {"seed=7", "repeats=3", "threads_per_cell=2", "device=cuda",
                                 "method.halves-wide.margin=0.15", "scenario.shove.count=2",
                                 "shape.*.longest_side=1", "shape.slab.resolution=4"}) {
    suite = with_override(suite, assignment, catalog);
  }
  EXPECT_EQ(suite.seed, 7);
  EXPECT_EQ(suite.repeats, 3);
  EXPECT_EQ(suite.threads_per_cell, 2);
  EXPECT_EQ(suite.device, "cuda");
  EXPECT_EQ(suite.methods[0].options.number("margin"), 0.1);
  EXPECT_EQ(suite.methods[1].options.number("margin"), 0.15);
  EXPECT_EQ(suite.scenarios[0].options.integer("count"), 2);
  EXPECT_EQ(suite.scenarios[0].options.number("speed"), 40);
  EXPECT_EQ(suite.shapes[0].request.longest_side, 1);
  EXPECT_EQ(suite.shapes[1].request.longest_side, 1);
  EXPECT_EQ(suite.shapes[1].request.resolution, 4);
}

TEST_F(SuiteTest, OverridesThatCannotBeMeantAreRefusedWithTheWayOut) {
  EXPECT_THAT(set_message("seed"), HasSubstr("key=value"));
  EXPECT_THAT(set_message("sede=3"), HasSubstr("did you mean 'seed'?"));
  EXPECT_THAT(set_message("methods.halves.margin=1"), HasSubstr("did you mean 'method'?"));
  EXPECT_THAT(set_message("method.halvse.margin=0"), HasSubstr("did you mean 'halves'?"));
  EXPECT_THAT(set_message("method.halves.margn=0"), HasSubstr("did you mean 'margin'?"));
  EXPECT_THAT(set_message("method.halves.margin=9"), HasSubstr("0 to 0.2 m"));
  EXPECT_THAT(set_message("method.halves=9"), HasSubstr("method.LABEL.OPTION"));
  EXPECT_THAT(set_message("shape.box.resolution=-1"), HasSubstr("0 to 4096"));
  EXPECT_THAT(set_message("seed=-1"), HasSubstr("at least 0"));
  EXPECT_THAT(set_message("device=gpu"), HasSubstr("known: cpu, cuda"));
}

TEST_F(SuiteTest, LimitsStandAtTheTopForAllMethodsOrWithOne) {
  std::string text = toy_suite_text();
  EXPECT_EQ(parse_suite(text, "toy.toml", catalog).methods[0].limits, CellLimits{});
  text.replace(text.find("seed = 5"), 8, "seed = 5\ntimeout_s = 20\nmemory_mb = 500\nwarm_up = 2");
  text += "timeout_s = 7\nprepare_timeout_s = 9\n";
  Suite suite = parse_suite(text, "toy.toml", catalog);
  EXPECT_EQ(suite.warm_up, 2);
  EXPECT_EQ(suite.methods[0].limits, (CellLimits{20, CellLimits{}.prepare_timeout_s, 500}));
  EXPECT_EQ(suite.methods[1].limits, (CellLimits{7, 9, 500}));
  const nlohmann::ordered_json before = to_json(suite);
  suite = with_override(suite, "memory_mb=900", catalog);
  suite = with_override(suite, "method.halves-wide.timeout_s=0.5", catalog);
  suite = with_override(suite, "warm_up=0", catalog);
  EXPECT_EQ(suite.methods[0].limits, (CellLimits{20, CellLimits{}.prepare_timeout_s, 900}));
  EXPECT_EQ(suite.methods[1].limits, (CellLimits{0.5, 9, 900}));
  EXPECT_EQ(to_json(suite), before) << "limits are no part of what a suite is";
  EXPECT_THAT(message("seed = 5", "timeout_s = -1"),
              AllOf(HasSubstr("toy.toml:3"), HasSubstr("at least 0 s")));
  EXPECT_THAT(message("margin = 0.2", "memory_mb = \"all\""), HasSubstr("toy.toml:20"));
  EXPECT_THAT(message("seed = 5", "timeout = 1"), HasSubstr("did you mean 'timeout_s'?"));
  EXPECT_THAT(set_message("memory_mb=-1"), HasSubstr("at least 0"));
}

TEST_F(SuiteTest, IsFoundByNameInTheUsersFoldersFirst) {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  std::ofstream(folder / "mine.toml") << toy_suite_text();
  setenv("FRACBENCH_SUITES", folder.c_str(), 1);
  EXPECT_EQ(find_suite_file("mine"), folder / "mine.toml");
  EXPECT_THAT(message_of([] { find_suite_file("mime"); }), HasSubstr("did you mean 'mine'?"));
  EXPECT_THAT(message_of([] { find_suite_file("no/mine.toml"); }), HasSubstr("no such"));
  bool listed = false;
  for (const SuiteFile& suite : list_suites()) listed |= suite.summary == "toys";
  EXPECT_TRUE(listed);
  unsetenv("FRACBENCH_SUITES");
}

TEST_F(SuiteTest, ItsJsonHoldsEveryValueThatDeterminesResults) {
  const nlohmann::ordered_json json = to_json(toy_suite(catalog));
  EXPECT_EQ(json["methods"]["halves-wide"]["options"]["margin"], 0.2);
  EXPECT_EQ(json["scenarios"]["shove"]["options"]["count"], 3);
  EXPECT_EQ(json["shapes"]["slab"]["longest_side"], 1.5);
  EXPECT_FALSE(json.contains("summary"));
  EXPECT_FALSE(json.contains("device"));
  EXPECT_EQ(to_json(with_override(toy_suite(catalog), "device=cuda", catalog))["device"], "cuda");
}

}  // namespace
}  // namespace fracbench
