#include "geometry/formats/text_line.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/error.h"

namespace fracbench::formats {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

}  // namespace

std::string quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text.substr(0, 40)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  return result + (text.size() > 40 ? "...'" : "'");
}

void Source::fail(std::string_view where, std::string_view what, std::string_view way_out) const {
  throw InputError(fmt::format("cannot read '{}': {}{}{}; {}", name, where,
                               where.empty() ? "" : ": ", what, way_out));
}

std::optional<double> parse_number(std::string_view word) {
  word = without_plus(word);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return {};
  // Too large, or too small to be told from 0: the C library says which.
  if (error == std::errc::result_out_of_range)
    value = std::strtod(std::string(word).c_str(), nullptr);
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  word = without_plus(word);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error != std::errc()) return {};
  return value;
}

void Words::skip_blanks() {
  std::size_t i = 0;
  while (i < rest_.size() && is_blank(rest_[i])) ++i;
  rest_.remove_prefix(i);
}

std::string_view Words::next() {
  skip_blanks();
  std::size_t i = 0;
  while (i < rest_.size() && !is_blank(rest_[i])) ++i;
  const std::string_view word = rest_.substr(0, i);
  rest_.remove_prefix(i);
  return word;
}

bool Words::at_end() {
  skip_blanks();
  return rest_.empty();
}

double Words::number(std::string_view what) {
  const std::string_view word = next();
  if (word.empty()) fail(fmt::format("{} is missing", what));
  const std::optional<double> value = parse_number(word);
  if (!value) fail(fmt::format("{} is {}, which is not a number", what, quoted(word)));
  if (!std::isfinite(*value)) fail(fmt::format("{} is {}, not finite", what, quoted(word)));
  return *value;
}

std::int64_t Words::integer(std::string_view what) {
  const std::string_view word = next();
  if (word.empty()) fail(fmt::format("{} is missing", what));
  const std::optional<std::int64_t> value = parse_integer(word);
  if (!value) fail(fmt::format("{} is {}, which is not a whole number", what, quoted(word)));
  return *value;
}

void Words::fail(std::string_view what) const {
  source_->fail(fmt::format("line {}", line_), what);
}

Lines::Lines(const Source& source, std::size_t start)
    : source_(&source),
      position_(start),
      end_(source.bytes.find('\n') == std::string_view::npos ? '\r' : '\n') {}

std::optional<std::string_view> Lines::next() {
  if (position_ >= source_->bytes.size()) return {};
  const std::size_t end = std::min(source_->bytes.find(end_, position_), source_->bytes.size());
  const std::string_view line = source_->bytes.substr(position_, end - position_);
  position_ = std::min(end + 1, source_->bytes.size());
  ++number_;
  return line;
}

std::optional<Words> Lines::next_words() {
  while (const std::optional<std::string_view> line = next()) {
    Words words(line->substr(0, line->find('#')), *source_, number_);
    if (!words.at_end()) return words;
  }
  return {};
}

}  // namespace fracbench::formats
