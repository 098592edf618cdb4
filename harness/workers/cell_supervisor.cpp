#include "harness/workers/cell_supervisor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string_view>

#include "core/error.h"
#include "core/process_tree.h"
#include "harness/workers/serve_cells.h"
#include "harness/workers/tree_bytes.h"

namespace fracbench {

namespace {

using Clock = std::chrono::steady_clock;

/// How often time and memory are looked at, and how soon a request to stop is heard.
constexpr auto kTick = std::chrono::milliseconds(20);
constexpr double kMebi = 1 << 20;
/// How long a process may live once it cannot answer any more.
constexpr auto kGrace = std::chrono::milliseconds(500);
/// A library that gets no memory often aborts: so it is taken where this share was used.
constexpr double kNearLimit = 0.9;

/// How many processes the system has ended for lack of memory since it was started.
std::uint64_t out_of_memory_kills() {
  std::ifstream statistics("/proc/vmstat");
  std::string name;
  for (std::uint64_t value = 0; statistics >> name >> value;) {
    if (name == "oom_kill") return value;
  }
  return 0;
}

/// One cell under way.
class Supervision {
 public:
  Supervision(WorkerProcess& worker, const SupervisionOptions& options, Progress& progress)
      : worker_(worker), options_(options), progress_(progress), kills_(out_of_memory_kills()) {}

  std::variant<Record, WorkerLoss> run(const std::stop_token& stop) {
    try {
      while (true) {
        if (stop.stop_requested()) throw Cancelled();
        if (const auto message = worker_.wait(kTick)) {
          if (message->kind == MessageKind::record) {
            return to_record(tree_from_bytes(message->body));
          }
          take(*message);
        } else if (worker_.ended()) {
          return loss_by_its_own();
        }
        if (auto loss = look()) return *loss;
      }
    } catch (const DataError& error) {
      return lost(CellStatus::crash, fmt::format("the answer {}", error.what()));
    }
  }

 private:
  void take(const Message& message) {
    const std::string_view body = message.body;
    switch (message.kind) {
      case MessageKind::phase:
        if (body.size() != 1 || body[0] < 0 || body[0] > static_cast<char>(CellPhase::measure)) {
          break;
        }
        enter(static_cast<CellPhase>(body[0]));
        return;
      case MessageKind::progress: {
        double fraction = 0;
        if (body.size() < sizeof fraction) break;
        std::memcpy(&fraction, body.data(), sizeof fraction);
        if (!std::isfinite(fraction)) fraction = 0;
        progress_.update(body.substr(sizeof fraction), fraction);
        return;
      }
      case MessageKind::refusal:
        throw InputError(message.body);
      default:
        break;
    }
    throw DataError("is none that a worker gives");
  }

  /// A phase begins once, but for warm-up runs: time does not start anew for the same work.
  void enter(CellPhase phase) {
    if (phase < phase_) throw DataError("goes back to what was done");
    if (phase == phase_ && phase != CellPhase::warm_up) return;
    phase_ = phase;
    phase_start_ = Clock::now();
  }

  /// At the limits; many times a second.
  std::optional<WorkerLoss> look() {
    const auto now = Clock::now();
    if (now < next_look_) return std::nullopt;
    next_look_ = now + kTick;
    if (!worker_.hung_up()) alive_ = now;
    if (now - alive_ > kGrace) {
      return lost(CellStatus::crash, "the process closed the connection to its supervisor");
    }
    const CellLimits& limits = options_.limits;
    const bool preparing = phase_ == CellPhase::prepare;
    const double allowed = preparing ? limits.prepare_timeout_s : limits.timeout_s;
    const std::chrono::duration<double> taken = now - phase_start_;
    if (allowed > 0 && taken.count() > allowed) {
      const std::string_view what = preparing                      ? "preparing the body"
                                    : phase_ == CellPhase::warm_up ? "a warm-up run"
                                                                   : "the cell";
      const std::string name = preparing ? "prepare_timeout_s" : "timeout_s";
      return lost(CellStatus::timeout,
                  fmt::format("{} took longer than {} = {} s", what, name, allowed), name);
    }
    return look_at_memory();
  }

  std::optional<WorkerLoss> look_at_memory() {
    const std::uint64_t own = resident_memory(worker_.id());
    std::uint64_t all = own;
    for (const ::pid_t process : descendants(worker_.id())) all += resident_memory(process);
    // A child that was forked just now seems to have all that its parent has.
    const std::uint64_t steady = std::max(own, std::min(all, last_));
    last_ = all;
    peak_ = std::max(peak_, steady);
    const double limit = options_.limits.memory_mb;
    if (limit > 0 && static_cast<double>(steady) > limit * kMebi) {
      return lost(CellStatus::out_of_memory,
                  fmt::format("took more memory than memory_mb = {} MiB", limit), "memory_mb");
    }
    if (!options_.memory_pressure) return std::nullopt;
    std::string pressure = options_.memory_pressure(steady);
    if (pressure.empty()) return std::nullopt;
    return lost(CellStatus::out_of_memory, std::move(pressure), "memory_mb");
  }

  WorkerLoss loss_by_its_own() {
    const auto signal = worker_.signal();
    const double limit = options_.limits.memory_mb * kMebi;
    const bool by_system = signal == SIGKILL && out_of_memory_kills() > kills_;
    const bool near_limit = signal && limit > 0 && static_cast<double>(peak_) > kNearLimit * limit;
    if (worker_.exit_code() == kNoMemoryExitCode || by_system || near_limit) {
      return lost(CellStatus::out_of_memory,
                  fmt::format("got no more memory: the process {}", worker_.describe_end()),
                  "memory_mb");
    }
    return lost(CellStatus::crash,
                fmt::format("the process {} and gave no answer", worker_.describe_end()));
  }

  WorkerLoss lost(CellStatus status, std::string reason, std::string limit = "") {
    worker_.kill();
    if (const std::string output = worker_.last_output(); !output.empty()) {
      reason += "; its last output: " + output;
    }
    return {.status = status,
            .reason = std::move(reason),
            .limit = std::move(limit),
            .phase = phase_,
            .seconds = std::chrono::duration<double>(Clock::now() - start_).count(),
            .peak_memory = peak_};
  }

  WorkerProcess& worker_;
  const SupervisionOptions& options_;
  Progress& progress_;
  const std::uint64_t kills_;
  CellPhase phase_ = CellPhase::prepare;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point phase_start_ = start_;
  Clock::time_point next_look_ = start_;
  Clock::time_point alive_ = start_;  ///< when its connection was last seen to be open
  std::uint64_t last_ = 0;
  std::uint64_t peak_ = 0;
};

}  // namespace

std::variant<Record, WorkerLoss> supervise(WorkerProcess& worker, const SupervisionOptions& options,
                                           Progress& progress, const std::stop_token& stop) {
  worker.clear_output();
  return Supervision(worker, options, progress).run(stop);
}

}  // namespace fracbench
