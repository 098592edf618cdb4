#include "harness/terminal_progress.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "harness/cost_model.h"

namespace fracbench {

namespace {

constexpr auto kLineInterval = std::chrono::seconds(5);
constexpr int kUsualColumns = 80;

/// The first `columns` characters of UTF-8 text.
std::string shortened(const std::string& text, int columns) {
  int count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool starts_character = (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80;
    if (starts_character && ++count > columns) return text.substr(0, i);
  }
  return text;
}

}  // namespace

TerminalProgress::TerminalProgress(std::ostream& out, bool terminal, int columns, Describe describe)
    : out_(out),
      terminal_(terminal),
      columns_(columns),
      describe_(std::move(describe)),
      last_line_(std::chrono::steady_clock::now()) {}

TerminalProgress::~TerminalProgress() {
  if (line_shown_) out_ << "\n" << std::flush;
}

void TerminalProgress::update(const RunProgress& progress) {
  const auto text = [&] { return describe_ ? describe_(progress) : describe(progress); };
  if (terminal_) {
    // One column stays free: a full line would make some terminals wrap.
    out_ << "\r" << shortened(text(), columns_ - 1) << "\x1b[K" << std::flush;
    line_shown_ = true;
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  const bool finished = progress.done == progress.cells && progress.done != last_done_;
  if (!finished && now - last_line_ < kLineInterval) return;
  last_line_ = now;
  last_done_ = progress.done;
  out_ << text() << "\n" << std::flush;
}

void TerminalProgress::message(std::string_view text) {
  clear_line();
  out_ << text << "\n" << std::flush;
}

void TerminalProgress::clear_line() {
  if (line_shown_) out_ << "\r\x1b[K";
  line_shown_ = false;
}

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

int terminal_columns(int descriptor) {
  ::winsize size{};
  const bool known = ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsualColumns;
}

std::string describe(const RunProgress& progress) {
  const std::string cells = std::to_string(progress.cells);
  const double share = progress.cells == 0 ? 1 : double(progress.done) / double(progress.cells);
  std::string text =
      fmt::format("[{:>{}}/{}] {:.0f} %", progress.done, cells.size(), cells, 100 * share);
  if (progress.failed > 0) text += fmt::format(", {} failed", progress.failed);
  if (progress.done < progress.cells) {
    text += progress.seconds_left ? ", " + describe_seconds(*progress.seconds_left) + " left"
                                  : ", time left not known yet";
  }
  if (!progress.running.empty()) text += fmt::format("; {}", fmt::join(progress.running, "; "));
  return text;
}

}  // namespace fracbench
