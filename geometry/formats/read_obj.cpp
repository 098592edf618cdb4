#include <fmt/format.h>

#include <limits>

#include "geometry/formats/polygons.h"
#include "geometry/formats/readers.h"

namespace fracbench::formats {

namespace {

/// Calls visit(line, number of its first line) for every line, continued ones joined.
template <typename Visit>
void for_each_logical_line(const Source& source, const Visit& visit) {
  Lines lines(source);
  std::string joined;
  while (std::optional<std::string_view> line = lines.next()) {
    const std::size_t number = lines.number();
    const auto is_continued = [](std::string_view text) {
      if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
      return !text.empty() && text.back() == '\\';
    };
    if (!is_continued(*line)) {
      visit(*line, number);
      continue;
    }
    joined.clear();
    while (line && is_continued(*line)) {
      joined.append(line->substr(0, line->rfind('\\'))).push_back(' ');
      line = lines.next();
    }
    if (line) joined.append(*line);
    visit(joined, number);
  }
}

class ObjReader {
 public:
  explicit ObjReader(const Source& source) : source_(source) {
    polygons_.vertices.reserve(source.bytes.size() / 80);
    polygons_.reserve_faces(source.bytes.size() / 40);
  }

  TriangleMesh read() {
    for_each_logical_line(source_, [&](std::string_view line, std::size_t number) {
      Words words(line.substr(0, line.find('#')), source_, number);
      const std::string_view keyword = words.next();
      if (keyword == "v") {
        vertex(words);
      } else if (keyword == "f") {
        face(words, number);
      } else {
        for (const char c : keyword) {
          if (static_cast<unsigned char>(c) < 0x20) words.fail("this is not text, so no OBJ file");
        }
      }
    });
    const auto count = static_cast<std::int64_t>(polygons_.vertices.size());
    if (largest_ >= count) {
      source_.fail(
          fmt::format("line {}", line_of_largest_),
          fmt::format("vertex {} is out of range: the file has {} vertices", largest_ + 1, count));
    }
    return triangulated(std::move(polygons_), source_);
  }

 private:
  void vertex(Words& words) {
    if (polygons_.vertices.size() >= std::numeric_limits<std::int32_t>::max()) {
      words.fail("more than 2147483647 vertices");
    }
    const double x = words.number("x");
    const double y = words.number("y");
    const double z = words.number("z");
    polygons_.vertices.emplace_back(x, y, z);
  }

  void face(Words& words, std::size_t line) {
    std::size_t corners = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++corners) {
      // Only the vertex of vertex/texture/normal counts.
      const std::string_view number = word.substr(0, word.find('/'));
      const std::optional<std::int64_t> given = parse_integer(number);
      if (!given || *given == 0) {
        words.fail(
            fmt::format("a corner is {}, but vertices are numbered from 1, or from -1 "
                        "backwards",
                        quoted(word)));
      }
      // Negative numbers count back from the last vertex so far.
      const auto known = static_cast<std::int64_t>(polygons_.vertices.size());
      const std::int64_t index = *given > 0 ? *given - 1 : known + *given;
      if (index < 0 || index > std::numeric_limits<std::int32_t>::max()) {
        words.fail(
            fmt::format("vertex {} is out of range: {} vertices came before", *given, known));
      }
      if (index > largest_) {
        largest_ = index;
        line_of_largest_ = line;
      }
      polygons_.corners.push_back(static_cast<std::int32_t>(index));
    }
    if (corners < 3)
      words.fail(fmt::format("a face has {} corners, but needs at least 3", corners));
    if (corners > most_corners) {
      words.fail(fmt::format("a face has {} corners; at most {} are read", corners, most_corners));
    }
    polygons_.ends.push_back(polygons_.corners.size());
  }

  const Source& source_;
  Polygons polygons_;
  std::int64_t largest_ = -1;
  std::size_t line_of_largest_ = 0;
};

}  // namespace

TriangleMesh read_obj(const Source& source) { return ObjReader(source).read(); }

}  // namespace fracbench::formats
