#include "harness/prepare_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "harness/breakable_cache.h"

namespace fracbench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kProgressInterval = std::chrono::milliseconds(200);

/// Tells which body is being prepared, and what its method says of itself.
class BodyProgress final : public Progress {
 public:
  BodyProgress(const PrepareOptions& options, std::size_t bodies) : options_(options) {
    shown_.cells = bodies;
  }
  void start(std::string name) {
    name_ = std::move(name);
    show(name_);
  }
  void end(bool failed) {
    ++shown_.done;
    shown_.failed += failed;
    const std::chrono::duration<double> seconds = Clock::now() - begin_;
    shown_.seconds_left = seconds.count() / static_cast<double>(shown_.done) *
                          static_cast<double>(shown_.cells - shown_.done);
    show("");
  }
  void update(std::string_view what, double fraction) override {
    if (Clock::now() - last_ < kProgressInterval) return;
    show(fmt::format("{}: {} {:.0f} %", name_, what, 100 * fraction));
  }

 private:
  void show(std::string running) {
    last_ = Clock::now();
    if (!options_.progress) return;
    shown_.running.clear();
    if (!running.empty()) shown_.running.push_back(std::move(running));
    options_.progress(shown_);
  }

  const PrepareOptions& options_;
  RunProgress shown_;
  std::string name_;
  const Clock::time_point begin_ = Clock::now();
  Clock::time_point last_;
};

}  // namespace

PrepareResult prepare_methods(const Plan& plan, const PrepareOptions& options) {
  const std::vector<Cell> cells = bodies_of(plan);
  PrepareResult result{.rows = {}, .bodies = cells.size()};
  BodyProgress progress(options, cells.size());
  for (const Cell& cell : cells) {
    if (options.stop.stop_requested()) break;
    PreparedRow row{.shape = plan.shapes[cell.shape].label,
                    .method = plan.methods[cell.method].label,
                    .failure = {}};
    progress.start(fmt::format("{} {}", row.shape, row.method));
    StageTimer timer;
    Random random(cell.prepare_seed);
    Context context{.random = random,
                    .timer = timer,
                    .progress = progress,
                    .stop = options.stop,
                    .threads = plan.suite.threads_per_cell,
                    .device = plan.suite.device};
    try {
      const Prepared prepared = BreakableCache(plan).get(cell, context);
      row.seconds = prepared.seconds;
      row.failure = prepared.failure;
    } catch (const Cancelled&) {
      break;
    } catch (const InputError& error) {
      throw InputError(fmt::format("{} with method '{}': {}", row.shape, row.method, error.what()));
    } catch (const std::bad_alloc&) {
      row.failure = "the memory of this process was not enough";
    }
    progress.end(!row.failure.empty());
    result.rows.push_back(std::move(row));
  }
  return result;
}

ExitCode exit_code_of(const PrepareResult& result) {
  const bool good =
      result.rows.size() == result.bodies &&
      std::ranges::all_of(result.rows, [](const PreparedRow& row) { return row.failure.empty(); });
  return good ? ExitCode::good : ExitCode::not_measured;
}

nlohmann::ordered_json to_json(const PrepareResult& result) {
  auto list = nlohmann::ordered_json::array();
  for (const PreparedRow& row : result.rows) {
    list.push_back({{"shape", row.shape},
                    {"method", row.method},
                    {"seconds", row.seconds},
                    {"prepared", row.failure.empty()}});
    if (!row.failure.empty()) list.back()["reason"] = row.failure;
  }
  return list;
}

}  // namespace fracbench
