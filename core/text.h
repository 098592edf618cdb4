#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fracbench {

/// The candidate that was most likely meant by `word` (Damerau-Levenshtein distance at most a
/// third of its length, at least 1 and at most 4), if any.
std::optional<std::string> nearest(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean 'x'?" where a candidate is near, else "; known: a, b, c".
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

/// As a shell reads it as one word: itself, or in single quotes.
std::string shell_word(std::string_view text);

}  // namespace fracbench
