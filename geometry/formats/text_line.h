#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fracbench::formats {

/// A mesh file under way: its bytes, and its name for messages.
struct Source {
  std::string_view bytes;
  std::string name;

  /// Throws InputError: "cannot read 'name': where: what; way_out".
  [[noreturn]] void fail(std::string_view where, std::string_view what,
                         std::string_view way_out = default_way_out) const;

  static constexpr std::string_view default_way_out = "correct the file or export the mesh again";
};

/// The beginning of a piece of the file, in quotes and printable, for messages.
std::string quoted(std::string_view text);

/// The words of one line, taken from the front. Blanks, tabs and carriage returns separate them.
class Words {
 public:
  Words(std::string_view text, const Source& source, std::size_t line)
      : rest_(text), source_(&source), line_(line) {}

  /// Empty where the line is at its end.
  std::string_view next();
  bool at_end();

  /// The next word as a number; fails where there is none, or it is not finite. `what` names it.
  double number(std::string_view what);
  std::int64_t integer(std::string_view what);

  [[noreturn]] void fail(std::string_view what) const;

 private:
  void skip_blanks();

  std::string_view rest_;
  const Source* source_;
  std::size_t line_;
};

/// Takes a text apart into lines that end with a line feed, or a carriage return where the text has
/// no line feed; counted from 1.
class Lines {
 public:
  explicit Lines(const Source& source, std::size_t start = 0);

  /// The next line, without its end; nothing after the last.
  std::optional<std::string_view> next();
  /// The next line that holds words, up to a '#'.
  std::optional<Words> next_words();
  std::size_t number() const { return number_; }
  std::size_t position() const { return position_; }
  std::size_t bytes_left() const { return source_->bytes.size() - position_; }

 private:
  const Source* source_;
  std::size_t position_;
  std::size_t number_ = 0;
  char end_;
};

/// The double that a word spells (also with a leading '+'), infinities and NaN included; nothing
/// where it spells none.
std::optional<double> parse_number(std::string_view word);
std::optional<std::int64_t> parse_integer(std::string_view word);

}  // namespace fracbench::formats
