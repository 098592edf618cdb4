#pragma once

#include <fmt/format.h>

#include <compare>
#include <concepts>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

namespace fracbench {

/// A text of which a program has few that it meets often, such as the name of a metric: each is
/// stored once, for as long as the process lives, and a Name is a pointer to it. Equal names
/// compare in one step; their order is that of the texts. It comes from any text and reads as one.
/// From any number of threads.
class Name {
 public:
  Name() : Name(std::string_view()) {}
  // NOLINTBEGIN(google-explicit-constructor): it is a text, stored in another way
  Name(std::string_view text);
  Name(const std::string& text) : Name(std::string_view(text)) {}
  Name(const char* text) : Name(std::string_view(text)) {}

  operator const std::string&() const { return *text_; }
  operator std::string_view() const { return *text_; }
  // NOLINTEND(google-explicit-constructor)
  const std::string& text() const { return *text_; }
  bool empty() const { return text_->empty(); }

  friend bool operator==(Name a, Name b) { return a.text_ == b.text_; }
  friend std::strong_ordering operator<=>(Name a, Name b) {
    return a == b ? std::strong_ordering::equal : *a.text_ <=> *b.text_;
  }
  template <typename Text>
  requires(std::convertible_to<const Text&, std::string_view> &&
           !std::same_as<Text, Name>) friend bool
  operator==(Name a, const Text& text) {
    return std::string_view(*a.text_) == std::string_view(text);
  }

  friend std::string operator+(Name a, std::string_view b) { return *a.text_ + std::string(b); }
  friend std::string operator+(std::string_view a, Name b) { return std::string(a) + *b.text_; }

  friend std::ostream& operator<<(std::ostream& stream, Name name) { return stream << *name.text_; }

 private:
  const std::string* text_;
};

}  // namespace fracbench

template <>
struct fmt::formatter<fracbench::Name> : fmt::formatter<std::string_view> {
  template <typename Output>
  auto format(fracbench::Name name, Output& output) const {
    return fmt::formatter<std::string_view>::format(name.text(), output);
  }
};

/// What a name and a text are both: the text. Lets algorithms look for one among the others.
template <typename Text, template <typename> typename A, template <typename> typename B>
  requires std::same_as<Text, std::string> || std::same_as<Text, std::string_view>
struct std::basic_common_reference<fracbench::Name, Text, A, B> {
  using type = std::string_view;
};
template <typename Text, template <typename> typename A, template <typename> typename B>
  requires std::same_as<Text, std::string> || std::same_as<Text, std::string_view>
struct std::basic_common_reference<Text, fracbench::Name, A, B> {
  using type = std::string_view;
};
