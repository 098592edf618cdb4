#include "harness/conformance/cancel.h"

#include <fmt/format.h>

#include <chrono>
#include <functional>
#include <optional>
#include <thread>

#include "core/error.h"

namespace fracbench::conformance {

namespace {

constexpr double kStopSeconds = 1;  // within which work has to end when it is asked to

/// Runs the work and asks it to stop shortly after; how long it took from then, nothing where it
/// had ended before.
std::optional<double> seconds_to_stop(const std::function<void(std::stop_token)>& work) {
  using Clock = std::chrono::steady_clock;
  std::stop_source source;
  Clock::time_point asked;
  bool ended = false;
  {
    std::jthread asking([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      asked = Clock::now();
      source.request_stop();
    });
    try {
      work(source.get_token());
      ended = !source.stop_requested();
    } catch (const Cancelled&) {
    }
    if (ended) return std::nullopt;
  }
  return std::chrono::duration<double>(Clock::now() - asked).count();
}

}  // namespace

CheckResult check_cancel(const Bench& bench) {
  std::string text;
  const auto judge = [&](const char* what, std::optional<double> seconds) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", what,
                        seconds ? fmt::format("{:.2g} s", *seconds) : "done before");
    return !seconds || *seconds <= kStopSeconds;
  };
  const bool preparing = judge(
      "preparing", seconds_to_stop([&](const std::stop_token& stop) { bench.prepare(stop); }));
  const auto body = bench.prepare();
  const bool breaking = judge("breaking", seconds_to_stop([&](const std::stop_token& stop) {
                                bench.blow(*body, bench.impact(0), kSeed, stop);
                              }));
  return preparing && breaking ? passed(text) : failed(text);
}

}  // namespace fracbench::conformance
