#include "app/command_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include "harness/cost_model.h"
#include "harness/terminal_progress.h"

namespace fracbench {

namespace {

using namespace std::chrono_literals;

constexpr auto kQuiet = 2s;  // shorter work needs no progress
constexpr auto kTerminalPause = 200ms;
constexpr auto kPlainPause = 5s;
constexpr const char* kClearLine = "\r\033[K";

}  // namespace

CommandProgress::CommandProgress()
    : terminal_(is_terminal(STDERR_FILENO)), begin_(Clock::now()), last_(begin_ + kQuiet) {}

CommandProgress::~CommandProgress() {
  if (shown_ && terminal_) fmt::print(stderr, "{}", kClearLine);
}

void CommandProgress::update(std::string_view what, double fraction) {
  const Clock::time_point now = Clock::now();
  if (what != what_) {
    what_ = what;
    begin_ = now;
    first_ = fraction;
  }
  if (now < last_) return;
  last_ = now + (terminal_ ? Clock::duration(kTerminalPause) : Clock::duration(kPlainPause));
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  std::string text = fmt::format("{}: {:.0f} %", what, 100 * fraction);
  if (fraction > first_ && fraction < 1) {
    const double left = elapsed * (1 - fraction) / (fraction - first_);
    text += fmt::format(", {} left", describe_seconds(left));
  }
  fmt::print(stderr, "{}{}{}", terminal_ ? kClearLine : "", text, terminal_ ? "" : "\n");
  shown_ = true;
}

}  // namespace fracbench
