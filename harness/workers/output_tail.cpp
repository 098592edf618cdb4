#include "harness/workers/output_tail.h"

#include <algorithm>
#include <vector>

namespace fracbench {

namespace {

constexpr std::size_t kKept = 4096;  // bytes
constexpr std::size_t kLines = 5;
constexpr std::size_t kShown = 400;  // bytes

/// How many bytes the character at `i` has, 0 where it is no UTF-8.
std::size_t character_length(std::string_view text, std::size_t i) {
  const auto lead = static_cast<unsigned char>(text[i]);
  const std::size_t length = lead < 0x80    ? 1
                             : lead < 0xc2  ? 0
                             : lead < 0xe0  ? 2
                             : lead < 0xf0  ? 3
                             : lead <= 0xf4 ? 4
                                            : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return 0;
  }
  return length;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    const auto c = static_cast<unsigned char>(text[i]);
    if (length == 0) {
      result += '?';
    } else if (length == 1 && (c < 0x20 || c == 0x7f)) {
      result += ' ';
    } else {
      result += text.substr(i, length);
    }
    i += std::max<std::size_t>(length, 1);
  }
  const std::size_t first = result.find_first_not_of(' ');
  return first == std::string::npos
             ? ""
             : result.substr(first, result.find_last_not_of(' ') + 1 - first);
}

/// The end of a text, from the start of a character on.
std::string end_of(const std::string& text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  std::size_t start = text.size() - bytes;
  while (start < text.size() && (static_cast<unsigned char>(text[start]) & 0xc0) == 0x80) ++start;
  return "..." + text.substr(start);
}

}  // namespace

void OutputTail::add(std::string_view text) {
  if (text.size() > kKept) text.remove_prefix(text.size() - kKept);
  text_ += text;
  if (text_.size() > kKept) text_.erase(0, text_.size() - kKept);
}

std::string OutputTail::last_lines() const {
  std::vector<std::string> lines;
  std::size_t end = text_.size();
  while (lines.size() < kLines && end > 0) {
    const std::size_t line_break = text_.rfind('\n', end - 1);
    const std::size_t start = line_break == std::string::npos ? 0 : line_break + 1;
    std::string line = printable(std::string_view(text_).substr(start, end - start));
    if (!line.empty()) lines.push_back(std::move(line));
    end = start == 0 ? 0 : start - 1;
  }
  std::string result;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    result += (result.empty() ? "" : " | ") + *line;
  }
  return end_of(result, kShown);
}

}  // namespace fracbench
