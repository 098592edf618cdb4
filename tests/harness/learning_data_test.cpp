#include "harness/learning_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.h"
#include "harness/cell_executor.h"
#include "harness/data_file.h"
#include "harness/learning_plan.h"
#include "harness/learning_set.h"
#include "harness/prepare_methods.h"
#include "harness/record_store.h"
#include "harness/suite_overrides.h"
#include "harness/suite_reader.h"
#include "learning_world.h"
#include "temporary_folder.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class LearningDataTest : public testing::Test {
 protected:
  Suite suite(bool pupil = false, const std::vector<std::string>& settings = {}) const {
    Suite result = parse_suite(learning_suite_text(pupil), "toys.toml", catalog);
    for (const std::string& setting : settings) result = with_override(result, setting, catalog);
    return result;
  }
  LearningResult make(const Suite& suite, const fs::path& folder, int jobs = 1,
                      const std::vector<std::string>& shapes = {}) const {
    return make_learning_data(make_learning_plan(suite, catalog, shapes), suite.learning->split,
                              catalog, {.folder = folder, .jobs = jobs});
  }
  /// A folder with the data of suite(), made once and to be left as it is.
  fs::path made() const {
    static const TemporaryFolder folder;
    if (!fs::exists(folder.path() / "data")) make(suite(), folder.path() / "data");
    return folder.path() / "data";
  }
  /// The same to do with as one likes.
  fs::path copy_of_made() const {
    fs::copy(made(), base / "data", fs::copy_options::recursive);
    return base / "data";
  }
  static std::string index_bytes(const fs::path& folder) {
    std::ifstream stream(folder / "learning.json", std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static std::string message_of(const std::function<void()>& act) {
    try {
      act();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no InputError";
  }

  LearningWorld world;
  Catalog catalog = world.catalog();
  TemporaryFolder temporary;
  fs::path base = temporary.path();
};

TEST_F(LearningDataTest, CountsWhatBrokeWhatStayedWholeAndWhatFailed) {
  const LearningResult result = make(suite(), base / "data");
  ASSERT_TRUE(result.index);
  EXPECT_EQ(exit_code_of(result), ExitCode::good);
  ASSERT_EQ(result.index->shapes.size(), 2u);
  for (const LearningShape& shape : result.index->shapes) {
    EXPECT_EQ(shape.records.size(), 30u);
    EXPECT_EQ(shape.count(LearningRole::train), 12u);
    EXPECT_EQ(shape.count(LearningRole::test), 4u);
    std::size_t broken = 0;
    std::size_t unbroken = 0;
    double largest = 0;
    const RecordStore store(base / "data");
    for (const LearningRecord& entry : shape.records) {
      const Record record = store.read(entry.key);
      EXPECT_EQ(record.identity.scenario, entry.scenario);
      EXPECT_EQ(record.identity.shape, shape.label);
      EXPECT_EQ(result_digest(record), entry.result_digest);
      broken += record.outcome.status == CellStatus::ok;
      unbroken += record.outcome.status == CellStatus::unbroken;
      EXPECT_EQ(entry.role == LearningRole::unbroken,
                record.outcome.status == CellStatus::unbroken);
      const auto& scene = record.outcome.scene;
      if (record.outcome.status == CellStatus::invalid) continue;
      const Impact& impact = scene.impacts.empty() ? *scene.unbroken : scene.impacts.front();
      for (const Impulse& impulse : impact.impulses) {
        largest = std::max(largest, impulse.magnitude);
      }
    }
    EXPECT_EQ(shape.broken(), broken);
    EXPECT_EQ(shape.count(LearningRole::unbroken), unbroken);
    EXPECT_GT(unbroken, 3u);
    EXPECT_EQ(shape.max_impulse, largest);
    EXPECT_GT(largest, 0);
  }
  EXPECT_GT(result.index->count(LearningRole::failed), 0u);
}

TEST_F(LearningDataTest, IsTheSameForAnyNumberOfJobsAndWhenItIsMadeAgain) {
  make(suite(), base / "two", 2);
  const std::string bytes = index_bytes(made());
  EXPECT_GT(bytes.size(), 1000u);
  EXPECT_EQ(bytes, index_bytes(base / "two"));
  fs::remove(base / "two" / "learning.json");
  const LearningResult again = make(suite(), base / "two");
  EXPECT_EQ(again.run.found, 60u);
  EXPECT_EQ(bytes, index_bytes(base / "two"));
}

TEST_F(LearningDataTest, IsLoadedAsExamplesWithTheFragmentsOfTheirRecords) {
  const LearningIndex all = read_learning_index(made());
  const LearningSet set = load_learning_set(made());
  EXPECT_EQ(set.method, "halves");
  EXPECT_EQ(set.family, "shove");
  ASSERT_EQ(set.shapes.size(), 2u);
  const RecordStore store(made());
  for (const LearningShapeSet& shape : set.shapes) {
    const LearningShape& index = all.shape(shape.label, "");
    EXPECT_EQ(shape.train.size(), 12u);
    EXPECT_EQ(shape.test.size(), 4u);
    EXPECT_EQ(shape.unbroken, index.count(LearningRole::unbroken));
    EXPECT_EQ(shape.max_impulse, index.max_impulse);
    EXPECT_EQ(shape.mesh.faces.size(), 12u);
    std::size_t next = 0;
    for (const LearningRecord& entry : index.records) {
      if (entry.role != LearningRole::test) continue;
      const SceneResult scene = store.read(entry.key).outcome.scene;
      const LearningExample& example = shape.test[next++];
      ASSERT_EQ(example.fragments.size(), scene.fragments.size());
      EXPECT_EQ(example.fragments[0].mesh.vertices, scene.fragments[0].mesh.vertices);
      EXPECT_EQ(example.fragments[1].faces, scene.fragments[1].faces);
      ASSERT_FALSE(example.impact.impulses.empty());
      EXPECT_EQ(example.impact.impulses[0].point, scene.impacts[0].impulses[0].point);
      EXPECT_TRUE(example.later_impacts.empty());
      EXPECT_LE(example.impact.impulses[0].magnitude, shape.max_impulse);
    }
  }
}

TEST_F(LearningDataTest, SaysWithNumbersThatTooFewCollisionsBrokeAShape) {
  const LearningResult result = make(suite(false, {"learning.train=28"}), copy_of_made());
  EXPECT_EQ(exit_code_of(result), ExitCode::not_measured);
  ASSERT_EQ(result.shortages.size(), 2u);
  const std::size_t broken = result.index->shapes[0].broken();
  EXPECT_THAT(result.shortages[0],
              AllOf(HasSubstr("box: " + std::to_string(broken) + " of 30"),
                    HasSubstr("32 are needed (28 to train, 4 to test)"), HasSubstr("raise count")));
  // Another division needs no new collision.
  const LearningResult fewer =
      make(suite(false, {"learning.train=28", "learning.least=12"}), base / "data");
  EXPECT_EQ(fewer.run.found, 60u);
  EXPECT_EQ(exit_code_of(fewer), ExitCode::good);
  const LearningResult none =
      make(suite(false, {"learning.scenario.speed=5"}), base / "slow", 1, {"box"});
  EXPECT_EQ(none.index->shapes[0].broken(), 0u);
  EXPECT_THAT(none.shortages.at(0), HasSubstr("eq2-patch"));
  // Where the method is to blame, other balls are no way out.
  const LearningResult failed =
      make(suite(false, {"learning.options.trouble=failure", "learning.scenario.speed=100",
                         "learning.count=3"}),
           base / "failed", 1, {"box"});
  EXPECT_EQ(failed.index->shapes[0].count(LearningRole::failed), 3u);
  EXPECT_THAT(failed.shortages.at(0), AllOf(HasSubstr("the plane misses the box"),
                                            Not(HasSubstr("eq2-patch")), Not(HasSubstr("count"))));
}

TEST_F(LearningDataTest, IsContinuedWithMoreCollisionsAndRefusesOtherValues) {
  copy_of_made();
  const LearningResult more = make(suite(false, {"learning.count=33"}), base / "data");
  EXPECT_EQ(more.run.cells, 66u);
  EXPECT_EQ(more.run.found, 60u);
  EXPECT_EQ(more.index->shapes[0].records.size(), 33u);
  EXPECT_THAT(
      message_of([&] { make(suite(false, {"learning.scenario.speed=41"}), base / "data"); }),
      HasSubstr("belongs to another suite"));
}

TEST_F(LearningDataTest, OfSomeShapesIsAddedToThatOfTheOthers) {
  make(suite(), base / "parts", 1, {"slab"});
  EXPECT_EQ(read_learning_index(base / "parts").shapes.size(), 1u);
  make(suite(), base / "parts", 1, {"box"});
  EXPECT_EQ(index_bytes(made()), index_bytes(base / "parts"));
}

TEST_F(LearningDataTest, ThatIsStoppedHasNoIndexAndGoesOn) {
  std::stop_source source;
  const Suite toys = suite();
  const Plan plan = make_learning_plan(toys, catalog);
  const LearningResult stopped = make_learning_data(
      plan, toys.learning->split, catalog,
      {.folder = base / "data",
       .stop = source.get_token(),
       .progress =
           [&](const RunProgress& progress) {
             if (progress.done > 0) source.request_stop();
           },
       .execute =
           [&, executor = std::make_shared<CellExecutor>(plan, catalog, true)](
               const Cell& cell, Progress& progress, const std::stop_token& stop) {
             std::this_thread::sleep_for(std::chrono::milliseconds(20));
             return executor->execute(cell, progress, stop);
           }});
  EXPECT_FALSE(stopped.index);
  EXPECT_TRUE(stopped.run.stopped);
  EXPECT_EQ(exit_code_of(stopped), ExitCode::not_measured);
  EXPECT_FALSE(fs::exists(base / "data" / "learning.json"));
  EXPECT_THAT(message_of([&] { load_learning_set(base / "data"); }),
              HasSubstr("fracbench prepare"));
  make(toys, base / "data");
  EXPECT_EQ(index_bytes(base / "data"), index_bytes(made()));
}

TEST_F(LearningDataTest, DamagedOrExchangedRecordsAreNotLearnedFrom) {
  const LearningIndex index = read_learning_index(copy_of_made());
  const auto& records = index.shapes[0].records;
  const auto trained = std::ranges::find(records, LearningRole::train, &LearningRecord::role);
  const fs::path file = base / "data" / "records" / (trained->key + ".h5");
  const fs::path other = base / "data" / "records" / (std::next(trained)->key + ".h5");
  fs::copy_file(other, file, fs::copy_options::overwrite_existing);
  EXPECT_THROW(load_learning_set(base / "data"), DataError);
  fs::resize_file(file, 1000);
  EXPECT_THROW(load_learning_set(base / "data"), DataError);
  make(suite(), base / "data");
  EXPECT_NO_THROW(load_learning_set(base / "data"));
}

TEST_F(LearningDataTest, MeetsOtherScenesThanTheSuiteUnlessItIsGivenItsSeed) {
  const auto first_scene = [](const Plan& plan) {
    return to_json(plan.shapes[0].scenarios[0].scenario)["balls"].dump();
  };
  const auto of_suite = [&](const std::vector<std::string>& settings) {
    const Suite all = suite(true, settings);
    return std::pair(first_scene(make_plan(all, catalog)),
                     first_scene(make_learning_plan(all, catalog)));
  };
  const auto [measured, learned] = of_suite({"scenario.shove.speed=40"});
  EXPECT_NE(measured, learned);
  const auto [same, as_measured] = of_suite({"scenario.shove.speed=40", "learning.seed=5"});
  EXPECT_EQ(same, as_measured);
}

TEST_F(LearningDataTest, IsHandedToMethodsThatLearnAndIsPartOfTheirKeys) {
  const Suite toys = suite(true);
  const LearningIndex learned = read_learning_index(made());
  Plan plan = make_plan(toys, catalog, {.methods = {}, .shapes = {"slab"}});
  plan.learning_folder = made();
  EXPECT_TRUE(has_learning_data(plan, plan.learning_folder));
  const RunResult result = run_suite(plan, catalog, {.folder = base / "results"});
  EXPECT_TRUE(result.complete());
  EXPECT_EQ(last_lesson().examples, 12u);
  EXPECT_EQ(last_lesson().max_impulse, learned.shape("slab", "").max_impulse);

  const auto keys = [&](const std::vector<std::string>& settings) {
    std::pair<std::string, std::string> found;
    const Plan other = make_plan(suite(true, settings), catalog);
    for (const Cell& cell : other.cells) {
      (cell.method == 0 ? found.first : found.second) = cell.key;
    }
    return found;
  };
  for (const char* setting : {"learning.train=11", "learning.count=31", "learning.threads=2",
                              "learning.options.margin=0.1", "learning.seed=9"}) {
    EXPECT_EQ(keys({}).first, keys({setting}).first) << setting;
    EXPECT_NE(keys({}).second, keys({setting}).second) << setting;
  }
}

TEST_F(LearningDataTest, OfSeveralShapesIsHandedToAMethodThatLearnsThemTogether) {
  const std::string text = learning_suite_text(true) + "learn_with = [\"box\", \"slab\"]\n";
  const Suite together = parse_suite(text, "toys.toml", catalog);
  const PlanOptions slab{.methods = {}, .shapes = {"slab"}};
  EXPECT_EQ(learning_shapes(together, slab), (std::vector<std::string>{"box", "slab"}));
  EXPECT_EQ(learning_shapes(together, {.methods = {"halves"}, .shapes = {"slab"}}),
            std::vector<std::string>{"slab"});
  Plan plan = make_plan(together, catalog, slab);
  plan.learning_folder = made();
  EXPECT_TRUE(has_learning_data(plan, plan.learning_folder));
  EXPECT_TRUE(run_suite(plan, catalog, {.folder = base / "results"}).complete());
  const LearningShapeSet box =
      load_learning_shape(made(), read_learning_index(made()).shape("box", ""));
  EXPECT_EQ(last_lesson().examples, 12u);
  ASSERT_EQ(last_lesson().further.size(), 1u);
  const Lesson lesson = last_lesson();
  const FurtherLearning& further = lesson.further.front();
  EXPECT_EQ(further.shape, "box");
  EXPECT_EQ(further.mesh.vertices, box.mesh.vertices);
  EXPECT_EQ(further.examples.size(), box.train.size());
  EXPECT_EQ(further.max_impulse, box.max_impulse);

  // One seed for what they share, and the data of both in the keys.
  const auto cells_of = [&](const Suite& of) {
    std::map<std::string, Cell> cells;
    const Plan all = make_plan(of, catalog);
    for (const Cell& cell : all.cells) {
      if (cell.method == 1) cells[all.shapes[cell.shape].label] = cell;
    }
    return cells;
  };
  const auto both = cells_of(together), alone = cells_of(suite(true));
  EXPECT_EQ(both.at("box").prepare_seed, both.at("slab").prepare_seed);
  EXPECT_NE(alone.at("box").prepare_seed, alone.at("slab").prepare_seed);
  EXPECT_NE(both.at("box").key, alone.at("box").key);

  const auto message = [&](const std::string& from, const std::string& to) {
    std::string bad = text;
    bad.replace(bad.find(from), from.size(), to);
    return message_of([&] { make_plan(parse_suite(bad, "t.toml", catalog), catalog); });
  };
  EXPECT_THAT(message("learn_with = [\"box\"", "learn_with = [\"bix\""),
              AllOf(HasSubstr("learn_with"), HasSubstr("did you mean 'box'")));
  EXPECT_THAT(message("name = \"pupil\"", "name = \"halves\"\nlabel = \"b\""),
              HasSubstr("does not learn several shapes"));
}

TEST_F(LearningDataTest, OfOtherValuesIsNotHandedToAMethod) {
  Plan plan = make_plan(suite(true, {"learning.train=11"}), catalog);
  plan.learning_folder = made();
  EXPECT_FALSE(has_learning_data(plan, plan.learning_folder));
  EXPECT_THAT(message_of([&] { prepare_methods(plan, {}); }), HasSubstr("made by other values"));
  plan.learning_folder = base / "nowhere";
  EXPECT_THAT(message_of([&] { prepare_methods(plan, {}); }), HasSubstr("learning.json"));
}

TEST_F(LearningDataTest, MustComeFromAMethodThatDoesNotLearnForAllShapesOfThoseThatDo) {
  std::string text = learning_suite_text(true);
  text.erase(text.find("[learning]"), text.find("[[scenario]]") - text.find("[learning]"));
  EXPECT_THAT(message_of([&] { make_plan(parse_suite(text, "t.toml", catalog), catalog); }),
              HasSubstr("has no table [learning]"));
  text = learning_suite_text(true);
  text.replace(text.find("method = \"halves\""), 17, "method = \"pupil\" ");
  EXPECT_THAT(
      message_of([&] { make_learning_plan(parse_suite(text, "t.toml", catalog), catalog); }),
      HasSubstr("learns itself"));
  text = learning_suite_text(true);
  text.replace(text.find("train = 12"), 10, "shapes = [\"box\"]");
  EXPECT_THAT(message_of([&] { make_plan(parse_suite(text, "t.toml", catalog), catalog); }),
              HasSubstr("no learning data for shape 'slab'"));
}

TEST_F(LearningDataTest, ProgressTellsHowManyBrokeAndHowManyStayedWhole) {
  const std::string text = describe_learning({.cells = 300,
                                              .done = 12,
                                              .found = 0,
                                              .failed = 1,
                                              .unbroken = 3,
                                              .seconds_left = 80,
                                              .running = {"pot single-0012 bem"}});
  EXPECT_EQ(text,
            "[ 12/300] 4 %, 8 broken, 3 unbroken, 1 failed, 1 min 20 s left; pot single-0012 bem");
}

TEST_F(LearningDataTest, MistakesInItsTableAreNamed) {
  const auto message = [&](const std::string& from, const std::string& to) {
    std::string text = learning_suite_text();
    text.replace(text.find(from), from.size(), to);
    return message_of([&] { parse_suite(text, "t.toml", catalog); });
  };
  EXPECT_THAT(message("train = 12", "tran = 12"),
              AllOf(HasSubstr("t.toml:9"), HasSubstr("did you mean 'train'")));
  EXPECT_THAT(message("train = 12", "train = 0"), HasSubstr("train"));
  EXPECT_THAT(message("margin", "margins"), HasSubstr("did you mean 'margin'"));
  EXPECT_THAT(message("speed", "sped"), HasSubstr("did you mean 'speed'"));
  EXPECT_THAT(message("\"halves\"", "\"halvs\""), HasSubstr("did you mean 'halves'"));
  EXPECT_THAT(message("[learning]", "[[learning]]"), HasSubstr("one table"));
  EXPECT_THAT(message("train = 12", "shapes = [\"bix\"]"), HasSubstr("did you mean 'box'"));
  EXPECT_THAT(message("test = 4", "test = 4\nleast = 17"), HasSubstr("more than the 16"));
  EXPECT_THAT(message("count = 30", "count = 0"), HasSubstr("count"));
}

TEST_F(LearningDataTest, PreparingMethodsTellsTheTimeAndWhoGaveUp) {
  Suite toys = parse_suite(toy_suite_text(), "toy.toml", catalog);
  toys = with_override(toys, "method.halves-wide.trouble=prepare", catalog);
  const Plan plan = make_plan(toys, catalog);
  const PrepareResult result = prepare_methods(plan, {});
  ASSERT_EQ(result.rows.size(), 4u);  // two shapes and two methods, however many scenes
  EXPECT_EQ(exit_code_of(result), ExitCode::not_measured);
  for (const PreparedRow& row : result.rows) {
    EXPECT_EQ(row.failure, row.method == "halves" ? "" : "cannot work on this box");
  }
  toys = with_override(toys, "method.*.trouble=none", catalog);
  EXPECT_EQ(exit_code_of(prepare_methods(make_plan(toys, catalog), {})), ExitCode::good);
}

}  // namespace
}  // namespace fracbench
