#include "harness/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/error.h"
#include "harness/cell_executor.h"
#include "harness/exit_code.h"
#include "harness/record_store.h"
#include "harness/suite_overrides.h"
#include "harness/summaries.h"
#include "stored_results.h"
#include "temporary_folder.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RunnerTest : public testing::Test {
 protected:
  Plan plan_with(std::initializer_list<const char*> assignments) {
    Suite changed = suite;
    for (const char* assignment : assignments) {
      changed = with_override(changed, assignment, catalog);
    }
    return make_plan(changed, catalog);
  }

  RunResult run(const Plan& plan, RunOptions options = {}) {
    if (options.folder.empty()) options.folder = folder;
    options.message = [this](std::string_view text) { messages.emplace_back(text); };
    return run_suite(plan, catalog, options);
  }

  TemporaryFolder temporary;
  fs::path base = temporary.path();
  fs::path folder = base / "results";
  ToyWorld world;
  Catalog catalog = world.catalog();
  Suite suite = toy_suite(catalog);
  std::vector<std::string> messages;
};

TEST_F(RunnerTest, MakesARecordForEveryCell) {
  const Plan plan = make_plan(suite, catalog);
  const RunResult result = run(plan);
  EXPECT_EQ(result.cells, 12);
  EXPECT_EQ(result.counts.at(CellStatus::ok), 12);
  EXPECT_TRUE(result.complete());
  EXPECT_EQ(exit_code_of(result), ExitCode::good);
  EXPECT_EQ(counts_as_json(result).dump(),
            R"({"cells":12,"found":0,"complete":true,"stopped":false,"ok":12,"unbroken":0,)"
            R"("invalid":0,"timeout":0,"out-of-memory":0,"crash":0})");
  const RecordStore store(folder);
  for (const Cell& cell : plan.cells) {
    const Record record = store.read(cell.key);
    EXPECT_EQ(record.outcome.scene.fragments.size(), 2);
    EXPECT_EQ(record.identity.seed, cell.seed);
    EXPECT_EQ(store.read_shape(record.identity.shape_digest).faces.size(), 12);
  }
  EXPECT_TRUE(fs::is_empty(folder / "claims"));
}

TEST_F(RunnerTest, DoesNothingWhereAllRecordsAreThere) {
  const Plan plan = make_plan(suite, catalog);
  run(plan);
  const auto before = fs::last_write_time(list_records(folder).front());
  const RunResult again = run(plan, {.folder = folder, .execute = [](auto&&...) -> Record {
                                       throw std::logic_error("measured again");
                                     }});
  EXPECT_EQ(again.found, 12);
  EXPECT_TRUE(again.complete());
  EXPECT_EQ(fs::last_write_time(list_records(folder).front()), before);
}

TEST_F(RunnerTest, ResultsAreTheSameForAnyNumberOfJobs) {
  const Plan plan = plan_with({"repeats=3"});
  run(plan, {.folder = base / "one"});
  run(plan, {.folder = base / "four", .jobs = 4});
  EXPECT_EQ(digests(base / "one").size(), plan.cells.size());
  EXPECT_EQ(digests(base / "one"), digests(base / "four"));
}

TEST_F(RunnerTest, AnotherSeedGivesOtherResults) {
  run(make_plan(suite, catalog), {.folder = base / "a"});
  run(plan_with({"seed=77"}), {.folder = base / "b"});
  const auto a = digests(base / "a");
  for (const auto& [key, digest] : digests(base / "b")) EXPECT_FALSE(a.contains(key));
}

TEST_F(RunnerTest, AllMethodsMeetTheSameImpact) {
  run(make_plan(suite, catalog));
  std::map<std::string, std::set<double>> impulses;
  for (const CellSummary& cell : read_summaries(folder)) {
    impulses[cell.shape + cell.scenario].insert(cell.impulses.at(0));
  }
  EXPECT_EQ(impulses.size(), 6);
  for (const auto& [where, values] : impulses) EXPECT_EQ(values.size(), 1);
}

TEST_F(RunnerTest, FailureIsARecordWithItsReason) {
  const std::map<std::string, std::pair<CellStatus, std::string>> cases = {
      {"failure", {CellStatus::invalid, "the plane misses the box"}},
      {"prepare", {CellStatus::invalid, "cannot work on this box"}},
      {"memory", {CellStatus::out_of_memory, "memory"}},
      {"error", {CellStatus::crash, "a mistake in the method"}},
      {"input", {CellStatus::invalid, "this impact is not for me"}},
      {"garbage", {CellStatus::invalid, "no meshes"}},
      {"leak", {CellStatus::invalid, "volume_ratio differs from 1 by -0.0"}}};
  for (const auto& [trouble, expected] : cases) {
    const Plan plan = plan_with({("method.*.trouble=" + trouble).c_str()});
    const RunResult result = run(plan, {.folder = base / trouble});
    EXPECT_EQ(result.counts.at(expected.first), 12) << trouble;
    EXPECT_EQ(exit_code_of(result), ExitCode::not_measured);
    EXPECT_EQ(run(plan, {.folder = base / trouble}).found, 12) << "every record can be read";
    for (const CellSummary& cell : read_summaries(base / trouble)) {
      EXPECT_EQ(cell.status, expected.first);
      EXPECT_THAT(cell.reason, HasSubstr(expected.second));
    }
  }
}

TEST_F(RunnerTest, OptionsThatAMethodRefusesEndTheRunAndNameShapeAndMethod) {
  EXPECT_THAT([&] { run(plan_with({"method.halves-wide.trouble=options"})); },
              testing::ThrowsMessage<InputError>(
                  HasSubstr("box with method 'halves-wide': these options cannot be met")));
}

TEST_F(RunnerTest, InvalidFragmentsAreKept) {
  const Plan plan = plan_with({"method.*.trouble=leak"});
  run(plan);
  EXPECT_EQ(RecordStore(folder).read(plan.cells[0].key).outcome.scene.fragments.size(), 2);
}

TEST_F(RunnerTest, ACollisionWithoutABreakIsAResult) {
  const RunResult result = run(plan_with({"scenario.shove.speed=5"}));
  EXPECT_EQ(result.counts.at(CellStatus::unbroken), 12);
  EXPECT_EQ(exit_code_of(result), ExitCode::good);
  for (const CellSummary& cell : read_summaries(folder)) {
    EXPECT_EQ(cell.breaks, 0);
    EXPECT_EQ(cell.impulses.size(), 1);
  }
}

TEST_F(RunnerTest, StageTimesAddUpToTheTotalWithinTwoPercent) {
  run(plan_with({"method.*.wait=0.01"}));
  double unnamed = 0;
  double total = 0;
  for (const CellSummary& cell : read_summaries(folder)) {
    double sum = 0;
    for (const StageTime& stage : cell.stages) sum += stage.seconds;
    EXPECT_NEAR(sum / cell.total_seconds, 1, 0.02);
    EXPECT_EQ(cell.stages[0].name, "other");
    unnamed += cell.stages[0].seconds;
    total += cell.total_seconds;
    EXPECT_GT(cell.total_seconds, 0.01);
    EXPECT_GT(cell.peak_memory, 1e6);
  }
  EXPECT_LT(unnamed, 0.1 * total) << "time in no stage of its own";
}

TEST_F(RunnerTest, WarmUpRunsComeOnceForEachBodyAndAreNotCounted) {
  std::atomic<int> scenes = 0;
  Catalog counting = catalog;
  counting.run_scene = [&](const Scenario& scenario, const Target& target,
                           std::shared_ptr<const Breakable> body, Context& context) {
    ++scenes;
    return catalog.run_scene(scenario, target, std::move(body), context);
  };
  run(make_plan(suite, catalog), {.folder = base / "cold"});
  Suite warm = with_override(suite, "warm_up=3", catalog);
  warm = with_override(warm, "method.*.wait=0.01", catalog);
  run_suite(make_plan(warm, counting), counting, {.folder = folder});
  EXPECT_EQ(scenes, 12 + 4 * 3) << "two shapes, two methods";
  double least = 1;
  for (const CellSummary& cell : read_summaries(folder)) {
    least = std::min(least, cell.total_seconds);
    double sum = 0;
    for (const StageTime& stage : cell.stages) sum += stage.seconds;
    EXPECT_NEAR(sum / cell.total_seconds, 1, 0.02);
  }
  EXPECT_LT(least, 0.03) << "with three more rounds of 0.01 s none can be as short";
  warm = with_override(suite, "warm_up=1", catalog);
  run(make_plan(warm, catalog), {.folder = base / "warm"});
  EXPECT_EQ(digests(base / "warm"), digests(base / "cold"));
}

TEST_F(RunnerTest, ADamagedRecordIsSetAsideAndMeasuredAgain) {
  const Plan plan = make_plan(suite, catalog);
  run(plan);
  const auto good = digests(folder);
  const RecordStore store(folder);
  const fs::path cut = store.record_file(plan.cells[3].key);
  fs::resize_file(cut, fs::file_size(cut) / 2);
  const fs::path swapped = store.record_file(plan.cells[5].key);
  fs::copy_file(store.record_file(plan.cells[4].key), swapped,
                fs::copy_options::overwrite_existing);
  const RunResult result = run(plan);
  EXPECT_EQ(result.found, 10);
  EXPECT_TRUE(result.complete());
  EXPECT_EQ(digests(folder), good);
  EXPECT_TRUE(fs::exists(cut.string() + ".damaged"));
  EXPECT_TRUE(fs::exists(swapped.string() + ".damaged"));
  EXPECT_THAT(messages, testing::UnorderedElementsAre(HasSubstr("cut short"),
                                                      HasSubstr("the record of another cell")));
}

TEST_F(RunnerTest, LeftoversOfKilledProcessesAreRemoved) {
  const Plan plan = make_plan(suite, catalog);
  run(plan);
  const fs::path part = folder / "records" / (plan.cells[0].key + ".h5.part");
  std::ofstream(part) << "half";
  std::ofstream(folder / "claims" / plan.cells[0].key);
  run(plan);
  EXPECT_FALSE(fs::exists(part));
  EXPECT_TRUE(fs::is_empty(folder / "claims"));
}

TEST_F(RunnerTest, TheTemporaryOfALivingWriterIsLeftAlone) {
  const Plan plan = make_plan(suite, catalog);
  run(plan);
  const auto claim = Claim::try_take(folder / "claims" / plan.cells[0].key);
  ASSERT_TRUE(claim);
  const fs::path part = folder / "records" / (plan.cells[0].key + ".h5.part");
  std::ofstream(part) << "half";
  EXPECT_TRUE(run(plan).complete());
  EXPECT_TRUE(fs::exists(part));
}

TEST_F(RunnerTest, AFolderOfAnotherSuiteIsRefusedWithTheValuesThatDiffer) {
  run(make_plan(suite, catalog));
  const Plan other = plan_with({"seed=9", "method.halves.margin=0.15"});
  EXPECT_THAT(
      [&] { run(other); },
      testing::ThrowsMessage<InputError>(testing::AllOf(
          HasSubstr("seed: 5 there, 9 here"),
          HasSubstr("methods.halves.options.margin: 0.1 there, 0.15 here"), HasSubstr("--out"))));
  EXPECT_EQ(list_records(folder).size(), 12);
}

TEST_F(RunnerTest, AFolderThatHoldsOtherThingsIsRefused) {
  fs::create_directories(folder);
  std::ofstream(folder / "letter.txt") << "dear";
  EXPECT_THROW(run(make_plan(suite, catalog)), InputError);
  std::ofstream(base / "file") << "x";
  EXPECT_THROW(run(make_plan(suite, catalog), {.folder = base / "file"}), InputError);
  EXPECT_THROW(run(make_plan(suite, catalog), {.folder = "/proc/none"}), InputError);
}

TEST_F(RunnerTest, PartsOfASuiteShareAFolder) {
  for (const int index : {1, 2, 3}) {
    run(make_plan(suite, catalog, {.shard = {index, 3}}));
  }
  EXPECT_EQ(run(make_plan(suite, catalog)).found, 12);
  EXPECT_EQ(read_results(folder).suite.cells, 12);
}

TEST_F(RunnerTest, RecordsOfAnotherSourceAreSetAside) {
  // The mesh of a shape changes while its name and values stay: other keys in the same folder.
  run(make_plan(suite, catalog));
  Catalog changed = catalog;
  changed.load_shape = [&](const ShapeRequest& request) {
    Shape shape = catalog.load_shape(request);
    if (shape.name == "box") shape.mesh = box_mesh(Vec3::Constant(-1), Vec3::Constant(1));
    return shape;
  };
  const Plan plan = make_plan(suite, changed);
  const RunResult result = run(plan);
  EXPECT_EQ(result.found, 6);
  EXPECT_EQ(read_summaries(folder).size(), 12);
  EXPECT_THAT(messages, testing::ElementsAre(HasSubstr("6 records")));
}

TEST_F(RunnerTest, StopsWhenAskedAndGoesOnLater) {
  const Plan plan = plan_with({"method.*.wait=0.1"});
  std::stop_source stop;
  std::jthread asker([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    stop.request_stop();
  });
  const RunResult result = run(plan, {.folder = folder, .jobs = 2, .stop = stop.get_token()});
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(exit_code_of(result), ExitCode::not_measured);
  EXPECT_EQ(list_records(folder).size(), result.recorded());
  EXPECT_LT(result.recorded(), 12);
  EXPECT_TRUE(run(plan, {.folder = folder, .jobs = 4}).complete());
}

TEST_F(RunnerTest, SeveralRunsShareAFolderWithoutDoingACellTwice) {
  const Plan plan = plan_with({"method.*.wait=0.02"});
  std::atomic<int> executed = 0;
  CellExecutor executor(plan, catalog, false);
  const auto one_run = [&] {
    RunOptions options{.folder = folder, .jobs = 2};
    options.execute = [&](const Cell& cell, Progress& progress, const std::stop_token& stop) {
      ++executed;
      return executor.execute(cell, progress, stop);
    };
    EXPECT_TRUE(run_suite(plan, catalog, options).complete());
  };
  {
    std::jthread a(one_run);
    std::jthread b(one_run);
  }
  EXPECT_EQ(executed, 12);
}

TEST_F(RunnerTest, ADiskThatIsFullEndsTheRunWithTheReasonAndNothingHalfWritten) {
  const Plan plan = make_plan(suite, catalog);
  std::stop_source stopped;
  stopped.request_stop();
  run(plan, {.folder = folder, .stop = stopped.get_token()});  // all but the records
  // A limit on the size of files stands for a disk that has no room for a whole record.
  std::signal(SIGXFSZ, SIG_IGN);
  ::rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const ::rlimit small{4096, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THAT([&] { run(plan, {.folder = folder, .jobs = 2}); },
              testing::ThrowsMessage<InputError>(HasSubstr((folder / "records").string())));
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_TRUE(fs::is_empty(folder / "records"));
  EXPECT_TRUE(fs::is_empty(folder / "claims"));
  EXPECT_TRUE(run(plan).complete());
}

TEST_F(RunnerTest, TellsHowFarItIsAndHowLongItWillTake) {
  const Plan plan = plan_with({"method.*.wait=0.05"});
  std::vector<RunProgress> seen;
  run(plan, {.folder = folder, .progress = [&](const RunProgress& p) { seen.push_back(p); }});
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.back().done, 12);
  EXPECT_EQ(seen.back().seconds_left, 0);
  EXPECT_FALSE(seen.front().seconds_left);
  bool named = false;
  for (const RunProgress& p : seen) {
    for (const std::string& text : p.running) named |= text.find("shove-") != std::string::npos;
  }
  EXPECT_TRUE(named);
}

}  // namespace
}  // namespace fracbench
