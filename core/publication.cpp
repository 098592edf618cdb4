#include "core/publication.h"

#include <fmt/format.h>

#include <string_view>

namespace fracbench {
namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("&%#_$").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// Where it appeared: "Journal 34(4), 2015".
std::string place(const Publication& publication) {
  std::string text = publication.journal.empty() ? publication.note : publication.journal;
  if (!publication.volume.empty()) text += ' ' + publication.volume;
  if (!publication.number.empty()) text += '(' + publication.number + ')';
  if (publication.year != 0) text += fmt::format(", {}", publication.year);
  return text;
}

}  // namespace

std::string citation(std::span<const Publication> publications) {
  std::string text;
  for (const Publication& p : publications) {
    if (!text.empty()) text += "; ";
    text += fmt::format("{}, \"{}\", {}", p.authors, p.title, place(p));
  }
  return text;
}

std::string to_bibtex(const Publication& p) {
  std::string entry = fmt::format("@{}{{{}", p.journal.empty() ? "misc" : "article", p.key);
  const auto add = [&](std::string_view field, const std::string& value) {
    if (!value.empty()) entry += fmt::format(",\n  {} = {{{}}}", field, value);
  };
  add("author", escaped(p.authors));
  add("title", fmt::format("{{{}}}", escaped(p.title)));
  add("journal", escaped(p.journal));
  add("volume", p.volume);
  add("number", p.number);
  add("year", p.year == 0 ? "" : fmt::format("{}", p.year));
  add("doi", p.doi);
  add("note", escaped(p.note));
  return entry + "\n}\n";
}

}  // namespace fracbench
