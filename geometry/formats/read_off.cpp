#include <fmt/format.h>

#include <limits>

#include "geometry/formats/polygons.h"
#include "geometry/formats/readers.h"

namespace fracbench::formats {

namespace {

struct Counts {
  std::size_t vertices = 0, faces = 0;
};

/// The keyword may be left out; the counts may follow it on its line.
Counts read_counts(Lines& lines, const Source& source) {
  std::optional<Words> words = lines.next_words();
  if (!words) source.fail("", "the file holds nothing but comments");
  Words peek = *words;
  const std::string_view keyword = peek.next();
  if (keyword.ends_with("OFF")) {
    const std::string_view prefix = keyword.substr(0, keyword.size() - 3);
    if (prefix.find_first_not_of("STCN") != std::string_view::npos) {
      words->fail(fmt::format("'{}' is not a mesh in three dimensions", keyword));
    }
    words = peek;
    if (words->at_end()) words = lines.next_words();
    if (!words) source.fail("", "the file ends before the numbers of vertices and faces");
    if (Words(*words).next() == "BINARY") words->fail("binary OFF files are not read");
  }
  const auto count = [&](std::string_view what) {
    const std::int64_t value = words->integer(what);
    // An element takes a line of two bytes at least.
    const auto most = std::min<std::int64_t>(static_cast<std::int64_t>(lines.bytes_left() / 2) + 1,
                                             std::numeric_limits<std::int32_t>::max());
    if (value < 0) words->fail(fmt::format("{} is {}, below 0", what, value));
    if (value > most) {
      words->fail(fmt::format("{} is {}, more than the file can hold", what, value));
    }
    return static_cast<std::size_t>(value);
  };
  const std::size_t vertices = count("the number of vertices");
  return {vertices, count("the number of faces")};
}

}  // namespace

TriangleMesh read_off(const Source& source) {
  Lines lines(source);
  const Counts counts = read_counts(lines, source);
  Polygons polygons;
  polygons.vertices.reserve(counts.vertices);
  polygons.reserve_faces(counts.faces);
  const auto next = [&](std::string_view what, std::size_t done, std::size_t count) {
    std::optional<Words> words = lines.next_words();
    if (!words) {
      source.fail("",
                  fmt::format("the file is cut short: {} of {} {} are there", done, count, what));
    }
    return *words;
  };
  for (std::size_t v = 0; v < counts.vertices; ++v) {
    Words words = next("vertices", v, counts.vertices);
    const double x = words.number("x");
    const double y = words.number("y");
    const double z = words.number("z");
    polygons.vertices.emplace_back(x, y, z);
  }
  for (std::size_t f = 0; f < counts.faces; ++f) {
    Words words = next("faces", f, counts.faces);
    const std::int64_t corners = words.integer("the number of corners");
    if (corners < 3 || corners > static_cast<std::int64_t>(most_corners)) {
      words.fail(fmt::format("a face has {} corners, but may have 3 to {}", corners, most_corners));
    }
    for (std::int64_t k = 0; k < corners; ++k) {
      const std::int64_t index = words.integer("a corner");
      if (index < 0 || index >= static_cast<std::int64_t>(counts.vertices)) {
        words.fail(fmt::format("vertex {} is out of range: there are {}, counted from 0", index,
                               counts.vertices));
      }
      polygons.corners.push_back(static_cast<std::int32_t>(index));
    }
    polygons.ends.push_back(polygons.corners.size());
  }
  return triangulated(std::move(polygons), source);
}

}  // namespace fracbench::formats
