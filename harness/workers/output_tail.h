#pragma once

#include <string>
#include <string_view>

namespace fracbench {

/// The end of what a process printed, however much that was.
class OutputTail {
 public:
  void add(std::string_view text);

  /// The last lines in one, such as "first | second": at most five lines and 400 characters,
  /// printable UTF-8. Empty where nothing was printed.
  std::string last_lines() const;

  void clear() { text_.clear(); }

 private:
  std::string text_;
};

}  // namespace fracbench
