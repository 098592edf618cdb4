#include "harness/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "harness/suite_overrides.h"
#include "harness/suite_reader.h"
#include "temporary_folder.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

class PlanTest : public testing::Test {
 protected:
  ToyWorld world;
  Catalog catalog = world.catalog();
  Suite suite = toy_suite(catalog);

  Plan plan_with(const std::string& assignment) {
    return make_plan(with_override(suite, assignment, catalog), catalog);
  }

  static std::set<std::string> keys(const Plan& plan) {
    std::set<std::string> result;
    for (const Cell& cell : plan.cells) result.insert(cell.key);
    return result;
  }

  static std::size_t shared(const std::set<std::string>& a, const std::set<std::string>& b) {
    std::size_t count = 0;
    for (const std::string& key : a) count += b.count(key);
    return count;
  }
};

TEST_F(PlanTest, HasACellForEveryShapeSceneMethodAndRepeat) {
  const Plan plan = plan_with("repeats=2");
  EXPECT_EQ(plan.cells.size(), 2 * 3 * 2 * 2);
  EXPECT_EQ(plan.suite_cells, plan.cells.size());
  EXPECT_EQ(keys(plan).size(), plan.cells.size());
  for (const std::string& key : keys(plan)) EXPECT_EQ(key.size(), 64);
}

TEST_F(PlanTest, IsTheSameEachTime) {
  EXPECT_EQ(keys(make_plan(suite, catalog)), keys(make_plan(suite, catalog)));
}

TEST_F(PlanTest, IsTheSameWhereverTheSuiteAndItsMeshFilesLie) {
  std::string text = toy_suite_text();
  text.replace(text.find("\"box\""), 5, "\"rock.obj\"");
  const TemporaryFolder here;
  const TemporaryFolder there;
  std::vector<Plan> plans;
  for (const TemporaryFolder* folder : {&here, &there}) {
    const std::filesystem::path mesh = folder->path() / "rock.obj";
    std::ofstream(mesh) << "\n";
    Catalog files = catalog;
    files.load_shape = [&](ShapeRequest request) {
      if (request.name == mesh) request.name = "box";
      return catalog.load_shape(request);
    };
    plans.push_back(make_plan(parse_suite(text, folder->path() / "toy.toml", files), files));
  }
  EXPECT_EQ(keys(plans[0]), keys(plans[1]));
  EXPECT_EQ(to_json(plans[0].suite), to_json(plans[1].suite));
}

TEST_F(PlanTest, PutsAllMethodsOnOneImpactNextToEachOther) {
  const Plan plan = make_plan(suite, catalog);
  for (std::size_t i = 0; i + 1 < plan.cells.size(); i += 2) {
    EXPECT_EQ(plan.cells[i].scenario, plan.cells[i + 1].scenario);
    EXPECT_EQ(plan.cells[i].shape, plan.cells[i + 1].shape);
    EXPECT_NE(plan.cells[i].method, plan.cells[i + 1].method);
    EXPECT_NE(plan.cells[i].seed, plan.cells[i + 1].seed);
  }
}

TEST_F(PlanTest, ScenesDependOnTheSeedAndNotOnMethodsOrTheirNumber) {
  const Plan all = make_plan(suite, catalog);
  const Plan more = plan_with("scenario.shove.count=5");
  const Plan other = plan_with("seed=6");
  for (std::size_t k = 0; k < 3; ++k) {
    const Ball& ball = all.shapes[0].scenarios[k].scenario.balls[0];
    EXPECT_EQ(ball.position, more.shapes[0].scenarios[k].scenario.balls[0].position);
    EXPECT_NE(ball.position, other.shapes[0].scenarios[k].scenario.balls[0].position);
    EXPECT_NE(ball.position, all.shapes[1].scenarios[k].scenario.balls[0].position);
  }
}

TEST_F(PlanTest, ALongerSuiteContainsTheCellsOfTheShorterOne) {
  const auto few = keys(make_plan(suite, catalog));
  EXPECT_EQ(shared(few, keys(plan_with("scenario.shove.count=5"))), few.size());
  EXPECT_EQ(shared(few, keys(plan_with("repeats=3"))), few.size());
}

TEST_F(PlanTest, KeysChangeWithEverythingThatDeterminesTheResult) {
  const auto base = keys(make_plan(suite, catalog));
  EXPECT_EQ(shared(base, keys(plan_with("seed=6"))), 0);
  EXPECT_EQ(shared(base, keys(plan_with("threads_per_cell=2"))), 0);
  EXPECT_EQ(shared(base, keys(plan_with("device=cuda"))), 0);
  EXPECT_EQ(shared(base, keys(plan_with("device=cpu"))), base.size());
  EXPECT_EQ(shared(base, keys(plan_with("scenario.shove.speed=41"))), 0);
  EXPECT_EQ(shared(base, keys(plan_with("shape.box.longest_side=1"))), base.size() / 2);
  EXPECT_EQ(shared(base, keys(plan_with("method.halves.margin=0.05"))), base.size() / 2);
}

TEST_F(PlanTest, KeysDoNotChangeWithWhatElseIsInTheSuite) {
  const auto all = keys(make_plan(suite, catalog));
  Suite one = suite;
  one.name = "other";
  one.methods.pop_back();
  one.shapes.erase(one.shapes.begin());
  const auto part = keys(make_plan(one, catalog));
  EXPECT_EQ(part.size(), 3);
  EXPECT_EQ(shared(part, all), 3);
}

TEST_F(PlanTest, FiltersKeepPartOfTheCellsAndTheirKeys) {
  const auto all = keys(make_plan(suite, catalog));
  const Plan wide = make_plan(suite, catalog, {.methods = {"halves-wide"}, .shapes = {"slab"}});
  EXPECT_EQ(wide.cells.size(), 3);
  EXPECT_EQ(wide.suite_cells, all.size());
  EXPECT_EQ(shared(keys(wide), all), 3);
  EXPECT_EQ(make_plan(suite, catalog, {.methods = {"halves"}}).cells.size(), all.size());
  EXPECT_THROW(make_plan(suite, catalog, {.methods = {"cvd"}}), InputError);
}

TEST_F(PlanTest, AMethodMayBreakSomeOfTheShapesOnly) {
  const auto all = keys(make_plan(suite, catalog));
  suite.methods[1].shapes = {"slab"};
  const Plan part = make_plan(suite, catalog);
  EXPECT_EQ(part.cells.size(), all.size() * 3 / 4);
  EXPECT_EQ(part.suite_cells, part.cells.size());
  EXPECT_EQ(shared(keys(part), all), part.cells.size());
  for (const Cell& cell : part.cells) {
    EXPECT_TRUE(cell.method == 0 || part.shapes[cell.shape].label == "slab");
  }
}

TEST_F(PlanTest, ShardsDivideTheCellsAndKeepMethodsTogether) {
  const Suite big = with_override(suite, "scenario.shove.count=30", catalog);
  const Plan whole = make_plan(big, catalog);
  for (const int count : {1, 2, 3, 7}) {
    std::map<std::string, int> seen;
    for (int index = 1; index <= count; ++index) {
      const Plan part = make_plan(big, catalog, {.shard = {index, count}});
      std::map<std::pair<std::size_t, std::size_t>, int> methods;
      std::map<std::size_t, int> shapes;
      for (const Cell& cell : part.cells) {
        ++seen[cell.key];
        ++methods[{cell.shape, cell.scenario}];
        ++shapes[cell.shape];
      }
      for (const auto& [impact, number] : methods) EXPECT_EQ(number, 2);
      EXPECT_EQ(shapes.size(), 2) << "a shard should see every shape";
      EXPECT_NEAR(static_cast<double>(part.cells.size()), whole.cells.size() / double(count), 4);
    }
    EXPECT_EQ(seen.size(), whole.cells.size());
    for (const auto& [key, number] : seen) EXPECT_EQ(number, 1);
  }
}

TEST_F(PlanTest, ShardsThatCannotBeMeantAreRefused) {
  EXPECT_EQ(parse_shard("2/5").index, 2);
  for (const char* text : {"", "2", "0/5", "6/5", "1/0", "-1/2", "1/2x", "a/b", "1/"}) {
    EXPECT_THROW(parse_shard(text), InputError) << text;
  }
}

TEST_F(PlanTest, NamesAllShapesThatAreNotThereAndHowToGoOn) {
  suite.shapes.push_back({"cone", {.name = "cone"}});
  suite.shapes.push_back({"disc", {.name = "disc"}});
  try {
    make_plan(suite, catalog);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("cone"), testing::HasSubstr("disc"),
                                             testing::HasSubstr("--shapes box,slab")));
  }
}

}  // namespace
}  // namespace fracbench
