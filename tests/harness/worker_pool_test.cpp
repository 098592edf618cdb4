#include "harness/workers/worker_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "core/error.h"
#include "core/process_tree.h"
#include "harness/record_store.h"
#include "harness/runner.h"
#include "harness/suite_overrides.h"
#include "harness/summaries.h"
#include "hostile_method.h"
#include "stored_results.h"
#include "temporary_folder.h"
#include "tests/core/best_time.h"
#include "tests/core/processes.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kImpacts = 6;

// With a sanitizer, operator new ends the process instead of throwing, and all takes more memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

std::vector<::pid_t> numbers_in(const fs::path& file) {
  std::ifstream in(file);
  return {std::istream_iterator<::pid_t>(in), {}};
}

class WorkerPoolTest : public testing::Test {
 protected:
  Plan plan_with(const std::vector<std::string>& assignments) {
    Suite suite = hostile_suite(catalog);
    for (const std::string& assignment : assignments) {
      suite = with_override(suite, assignment, catalog);
    }
    return make_plan(suite, catalog);
  }

  /// The workers of this run are gone afterwards.
  RunResult run(const Plan& plan, RunOptions options = {}, WorkerPoolOptions workers = {}) {
    workers.command = {FRACBENCH_TOY_PROGRAM, "worker"};
    WorkerPool pool(plan, catalog, workers);
    if (options.folder.empty()) options.folder = folder;
    options.message = [this](std::string_view text) { messages.emplace_back(text); };
    options.execute = [&](const Cell& cell, Progress& progress, const std::stop_token& stop) {
      return pool.execute(cell, progress, stop);
    };
    options.ready = [&](const Cell& cell) { return pool.ready(cell); };
    return run_suite(plan, catalog, options);
  }

  /// The cells of the hostile method.
  std::vector<CellSummary> hostile_cells(const fs::path& results) {
    std::vector<CellSummary> cells = read_summaries(results);
    std::erase_if(cells, [](const CellSummary& cell) { return cell.label != "hostile"; });
    return cells;
  }

  TemporaryFolder temporary;
  fs::path base = temporary.path();
  fs::path folder = base / "results";
  ToyWorld world;
  Catalog catalog = world.catalog();
  std::vector<std::string> messages;
};

TEST_F(WorkerPoolTest, HandsTheDeviceToTheMethod) {
  const Plan plan = plan_with({"device=cuda"});
  run(plan);
  const RecordStore store(folder);
  std::size_t told = 0;
  for (const auto& file : list_records(folder)) {
    const Record record = store.read(file.stem().string());
    if (record.identity.method != "halves") continue;
    EXPECT_THAT(record.outcome.notes, testing::Contains("computed on cuda"));
    ++told;
  }
  EXPECT_GT(told, 0);
}

TEST_F(WorkerPoolTest, GivesTheSameBytesAsThisProcessForAnyNumberOfJobs) {
  const Plan plan = make_plan(toy_suite(catalog), catalog);
  ASSERT_TRUE(run_suite(plan, catalog, {.folder = base / "here"}).complete());
  ASSERT_TRUE(run(plan, {.folder = base / "one"}).complete());
  ASSERT_TRUE(run(plan, {.folder = base / "three", .jobs = 3}).complete());
  EXPECT_EQ(digests(base / "here").size(), plan.cells.size());
  EXPECT_EQ(digests(base / "one"), digests(base / "here"));
  EXPECT_EQ(digests(base / "three"), digests(base / "here"));
}

TEST_F(WorkerPoolTest, FailuresAreTheSameBytesAsInThisProcess) {
  for (const std::string trouble : {"failure", "prepare", "error", "memory", "garbage", "leak"}) {
    const Plan plan = plan_with({"method.halves.trouble=" + trouble, "scenario.shove.count=2"});
    run_suite(plan, catalog, {.folder = base / trouble / "here"});
    run(plan, {.folder = base / trouble / "worker"});
    EXPECT_EQ(digests(base / trouble / "worker"), digests(base / trouble / "here")) << trouble;
  }
}

TEST_F(WorkerPoolTest, WarmUpRunsDoNotShowInTheResult) {
  const Plan plan = make_plan(toy_suite(catalog), catalog);
  run(plan, {.folder = base / "cold"});
  run(make_plan(with_override(toy_suite(catalog), "warm_up=2", catalog), catalog),
      {.folder = base / "warm"});
  EXPECT_EQ(digests(base / "warm"), digests(base / "cold"));
}

struct Attack {
  const char* name;
  CellStatus status;
  const char* reason;
  const char* setting = "seed=3";
};

void PrintTo(const Attack& attack, std::ostream* out) { *out << attack.name; }

class HostileMethodTest : public WorkerPoolTest, public testing::WithParamInterface<Attack> {};

TEST_P(HostileMethodTest, BecomesARecordOfItsStatusAndTheRunGoesOn) {
  const Attack& attack = GetParam();
  if (kSanitized && std::string_view(attack.name) == "allocate-at-once") {
    GTEST_SKIP() << "the sanitizer's operator new does not throw";
  }
  const fs::path children = base / "children";
  const Plan plan =
      plan_with({std::string("method.hostile.attack=") + attack.name, "scenario.shove.count=2",
                 "method.hostile.children=" + children.string(), attack.setting});
  const RunResult result = run(plan, {.folder = folder, .jobs = 2});
  EXPECT_TRUE(result.complete());
  EXPECT_EQ(result.count(CellStatus::ok), attack.status == CellStatus::ok ? 4 : 2);
  for (const CellSummary& cell : hostile_cells(folder)) {
    EXPECT_EQ(cell.status, attack.status) << to_string(cell.status) << ": " << cell.reason;
    EXPECT_THAT(cell.reason, HasSubstr(attack.reason));
    EXPECT_LT(cell.total_seconds, 12);
  }
  EXPECT_TRUE(all_gone(numbers_in(children)));
  EXPECT_TRUE(descendants(::getpid()).empty());
  EXPECT_EQ(run(plan).found, plan.cells.size()) << "every record can be read, and counts";
}

// What must have its memory before time is up gets more time.
INSTANTIATE_TEST_SUITE_P(
    Attacks, HostileMethodTest,
    testing::Values(
        Attack{"hang", CellStatus::timeout, "the cell took longer than timeout_s = 1 s"},
        Attack{"spin", CellStatus::timeout, "timeout_s = 1 s"},
        Attack{"stop", CellStatus::timeout, "timeout_s = 1 s"},
        Attack{"segfault", CellStatus::crash, "signal 11 (Segmentation fault)"},
        Attack{"stack", CellStatus::crash, "signal 11"},
        Attack{"abort", CellStatus::crash, "signal 6 (Aborted)"},
        Attack{"kill", CellStatus::crash, "signal 9"},
        Attack{"exit", CellStatus::crash, "ended with exit code 0 and gave no answer"},
        Attack{"exit-17", CellStatus::crash, "ended with exit code 17 and gave no answer"},
        Attack{"throw", CellStatus::crash, "a mistake"},
        Attack{"terminate", CellStatus::crash, "signal 6"},
        Attack{"thread", CellStatus::out_of_memory, "got no more memory"},
        Attack{"allocate", CellStatus::out_of_memory, "memory_mb = 400 MiB",
               "method.hostile.timeout_s=60"},
        Attack{"allocate-at-once", CellStatus::out_of_memory, "memory"},
        Attack{"print-for-ever", CellStatus::timeout, "its last output: all work and no play"},
        Attack{"print-and-answer", CellStatus::ok, "", "method.hostile.timeout_s=60"},
        Attack{"print-and-abort", CellStatus::crash,
               "its last output: first | second | ?  third \xc3\xa4"},
        Attack{"children", CellStatus::timeout, "timeout_s = 1 s"},
        Attack{"children-and-crash", CellStatus::crash, "signal 6"},
        Attack{"children-elsewhere", CellStatus::timeout, "timeout_s = 1 s"},
        Attack{"children-eat", CellStatus::out_of_memory, "memory_mb = 400 MiB",
               "method.hostile.timeout_s=60"},
        Attack{"garbage", CellStatus::crash, "the answer unknown message"},
        Attack{"huge-answer", CellStatus::crash, "claims to have 4611686018427387904 bytes"},
        Attack{"babble", CellStatus::timeout, "timeout_s = 1 s"},
        Attack{"close", CellStatus::crash, "closed the connection", "timeout_s=100"}),
    [](const auto& attack) {
      std::string name = attack.param.name;
      std::ranges::replace(name, '-', '_');
      return name;
    });

TEST_F(WorkerPoolTest, AWorkerThatFailedIsReplacedAndTheOthersServeOn) {
  const Plan plan = plan_with(
      {"method.hostile.attack=segfault", "method.hostile.share=0.5", "scenario.shove.count=20"});
  const RunResult result = run(plan);
  EXPECT_EQ(result.counts.size(), 2);
  EXPECT_GE(result.count(CellStatus::crash), 4);
  EXPECT_GE(result.count(CellStatus::ok), 24);
  EXPECT_TRUE(result.complete());
}

TEST_F(WorkerPoolTest, ABodyThatCannotBePreparedIsTriedOnce) {
  for (const std::string attack : {"hang", "abort", "thread"}) {
    const fs::path tries = base / (attack + "-tries");
    const Plan plan =
        plan_with({"method.hostile.attack=" + attack, "method.hostile.early=true",
                   "method.hostile.children=" + tries.string(), "prepare_timeout_s=0.7"});
    const RunResult result = run(plan, {.folder = base / attack});
    EXPECT_TRUE(result.complete());
    EXPECT_EQ(result.count(CellStatus::ok), kImpacts);
    for (const CellSummary& cell : hostile_cells(base / attack)) {
      if (attack == "hang") {
        EXPECT_EQ(cell.status, CellStatus::timeout);
        EXPECT_THAT(cell.reason, HasSubstr("preparing the body took longer than "
                                           "prepare_timeout_s = 0.7 s"));
      } else {
        EXPECT_EQ(cell.status, attack == "abort" ? CellStatus::crash : CellStatus::out_of_memory);
      }
    }
    EXPECT_EQ(numbers_in(tries).size(), 1) << attack;
  }
}

TEST_F(WorkerPoolTest, AWorkerServesAllCellsOfItsShapeAndMethod) {
  const Plan plan = make_plan(toy_suite(catalog), catalog);
  run(plan);
  std::map<std::string, std::set<double>> times;  // of preparing, by shape and method
  for (const CellSummary& cell : read_summaries(folder)) {
    times[cell.shape + cell.label.text()].insert(cell.prepare_seconds);
  }
  EXPECT_EQ(times.size(), 4);
  for (const auto& [kind, each] : times) EXPECT_EQ(each.size(), 1) << kind;
}

TEST_F(WorkerPoolTest, IdleWorkersBeyondTheirNumberAreEnded) {
  const Plan plan = make_plan(toy_suite(catalog), catalog);
  RunOptions options;
  std::size_t most = 0;
  options.progress = [&](const RunProgress&) {
    most = std::max(most, descendants(::getpid()).size());
  };
  EXPECT_TRUE(run(plan, options, {.idle = 1}).complete());
  EXPECT_LE(most, 2);
  EXPECT_EQ(digests(folder).size(), 12);
}

TEST_F(WorkerPoolTest, PeakMemoryIsThatOfTheWorkerEvenWithSeveralJobs) {
  if (kSanitized) GTEST_SKIP() << "a sanitizer takes memory of its own";
  std::vector<char> large(200 << 20, 1);  // of this process
  run(make_plan(toy_suite(catalog), catalog), {.folder = folder, .jobs = 3});
  for (const CellSummary& cell : read_summaries(folder)) {
    EXPECT_GT(cell.peak_memory, 1e6);
    EXPECT_LT(cell.peak_memory, 150e6);
  }
  EXPECT_EQ(large.back(), 1);
}

TEST_F(WorkerPoolTest, WhereTheMachineHasNoMemoryLeftTheLargestWorkerIsEnded) {
  // As if all of the machine were to stay free.
  const Plan plan = plan_with({"method.halves.wait=0.2", "scenario.shove.count=2", "memory_mb=0"});
  const RunResult result = run(plan, {}, {.reserve = ~std::uint64_t{0}});
  EXPECT_GE(result.count(CellStatus::out_of_memory), 2);
  EXPECT_TRUE(result.complete());
}

TEST_F(WorkerPoolTest, ACellIsTriedAgainOnceItsLimitIsHigher) {
  const std::string wait = "method.halves.wait=0.4";
  const Plan tight = plan_with({wait, "method.halves.timeout_s=0.1"});
  EXPECT_EQ(run(tight).count(CellStatus::timeout), kImpacts);
  EXPECT_EQ(run(tight).found, 2 * kImpacts);
  messages.clear();
  const Plan lower = plan_with({wait, "method.halves.timeout_s=0.05"});
  EXPECT_EQ(run(lower).found, 2 * kImpacts);
  const RunResult again = run(plan_with({wait, "method.halves.timeout_s=30"}));
  EXPECT_EQ(again.found, kImpacts);
  EXPECT_EQ(again.count(CellStatus::ok), 2 * kImpacts);
  EXPECT_THAT(messages, testing::Contains(
                            AllOf(HasSubstr("timeout_s = 0.1 s"), HasSubstr("measured again"))));
  EXPECT_EQ(run(tight).found, 2 * kImpacts) << "what was measured does not depend on a limit";
}

TEST_F(WorkerPoolTest, OptionsThatAMethodRefusesEndTheRun) {
  EXPECT_THAT([&] { run(plan_with({"method.halves.trouble=options"})); },
              testing::ThrowsMessage<InputError>(
                  HasSubstr("box with method 'halves': these options cannot be met")));
  EXPECT_TRUE(descendants(::getpid()).empty());
}

TEST_F(WorkerPoolTest, AProgramThatIsNoWorkerIsNoRecord) {
  const Plan plan = plan_with({"scenario.shove.count=1"});
  WorkerPool absent(plan, catalog, {.command = {"/no/such/program"}});
  Progress progress;
  EXPECT_THROW(absent.execute(plan.cells[0], progress, {}), std::system_error);
  WorkerPool other(plan, catalog, {.command = {"/bin/echo", "hello"}});
  const Record record = other.execute(plan.cells[0], progress, {});
  EXPECT_EQ(record.outcome.status, CellStatus::crash);
  EXPECT_THAT(record.outcome.reason, HasSubstr("hello"));
}

TEST_F(WorkerPoolTest, StopsWithinASecondWhateverTheMethodDoes) {
  for (const std::string attack : {"hang", "spin", "children-elsewhere"}) {
    const fs::path children = base / (attack + "-children");
    const Plan plan = plan_with({"method.hostile.attack=" + attack, "timeout_s=100",
                                 "method.hostile.children=" + children.string()});
    const auto stopped_run = [&] {
      std::stop_source stop;
      Clock::time_point asked;
      std::jthread asker([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(400));
        asked = Clock::now();
        stop.request_stop();
      });
      const RunResult result =
          run(plan, {.folder = base / attack, .jobs = 2, .stop = stop.get_token()});
      const auto ended = Clock::now();
      EXPECT_TRUE(result.stopped);
      EXPECT_TRUE(all_gone(numbers_in(children)));
      EXPECT_TRUE(descendants(::getpid()).empty());
      asker.join();
      return ended - asked;
    };
    constexpr std::chrono::milliseconds kLimit(700);
    EXPECT_LT(best_time(kLimit, stopped_run), kLimit) << attack;
  }
}

/// The toy program at work on a folder, in a process of its own.
::pid_t start_toy_run(const fs::path& folder, const std::vector<std::string>& settings) {
  std::vector<std::string> arguments = {FRACBENCH_TOY_PROGRAM, "run", folder.string(), "2"};
  arguments.insert(arguments.end(), settings.begin(), settings.end());
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  const ::pid_t child = ::fork();
  if (child != 0) return child;
  ::execv(FRACBENCH_TOY_PROGRAM, pointers.data());
  ::_exit(99);
}

TEST_F(WorkerPoolTest, AKilledSupervisorTakesItsWorkersAndTheirChildrenWithIt) {
  for (const std::string attack : {"hang", "spin", "stop", "children", "print-for-ever"}) {
    const fs::path children = base / (attack + "-children");
    const ::pid_t supervisor =
        start_toy_run(base / attack, {"method.hostile.attack=" + attack, "timeout_s=100",
                                      "method.hostile.children=" + children.string()});
    std::vector<::pid_t> workers;
    const auto deadline = Clock::now() + std::chrono::seconds(10);
    const std::size_t expected = attack == "children" ? 7 : 2;
    while (workers.size() < expected && Clock::now() < deadline) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      workers = descendants(supervisor);
    }
    EXPECT_GE(workers.size(), expected) << attack;
    ::kill(supervisor, SIGKILL);
    ::waitpid(supervisor, nullptr, 0);
    EXPECT_TRUE(all_gone(workers)) << attack;
    EXPECT_TRUE(all_gone(numbers_in(children))) << attack;
  }
}

TEST_F(WorkerPoolTest, AKilledSupervisorGoesOnWhereItWas) {
  const std::vector<std::string> settings = {"method.hostile.attack=abort",
                                             "method.hostile.share=0.3", "scenario.shove.count=12",
                                             "method.halves.wait=0.05"};
  const Plan plan = plan_with(settings);
  ASSERT_TRUE(run(plan, {.folder = base / "alone"}).complete());
  for (int attempt = 1; attempt <= 3; ++attempt) {
    const ::pid_t supervisor = start_toy_run(folder, settings);
    wait_for_records(folder, 5u * attempt, supervisor);
    ::kill(supervisor, SIGKILL);
    ::waitpid(supervisor, nullptr, 0);
    const std::size_t there = list_records(folder).size();
    EXPECT_GE(there, 5u * attempt);
    EXPECT_LT(there, plan.cells.size());
  }
  ASSERT_TRUE(run(plan, {.folder = folder, .jobs = 2}).complete());
  EXPECT_EQ(digests(folder), digests(base / "alone"));
}

}  // namespace
}  // namespace fracbench
