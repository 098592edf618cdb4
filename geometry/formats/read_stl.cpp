#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "geometry/equal_vertices.h"
#include "geometry/formats/readers.h"

namespace fracbench::formats {

namespace {

static_assert(std::endian::native == std::endian::little, "STL and PLY are read byte by byte");

constexpr std::size_t header_size = 84;
constexpr std::size_t facet_size = 50;

/// Three vertices per face become an indexed mesh.
TriangleMesh welded(std::vector<Vec3> corners) {
  const std::vector<std::int32_t> first = first_equal_vertex(corners);
  TriangleMesh mesh;
  std::vector<std::int32_t> renumbered(corners.size());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (first[c] == static_cast<std::int32_t>(c)) {
      renumbered[c] = static_cast<std::int32_t>(mesh.vertices.size());
      mesh.vertices.push_back(corners[c]);
    } else {
      renumbered[c] = renumbered[first[c]];
    }
  }
  mesh.faces.reserve(corners.size() / 3);
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
    mesh.faces.push_back({renumbered[c], renumbered[c + 1], renumbered[c + 2]});
  }
  return mesh;
}

std::uint32_t announced_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, 4);
  return count;
}

TriangleMesh read_binary(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (bytes.size() < header_size) {
    source.fail("", fmt::format("the file is cut short: {} bytes, but the header of a binary STL "
                                "file has {}",
                                bytes.size(), header_size));
  }
  const std::size_t count = announced_facets(bytes);
  if (bytes.size() < header_size + facet_size * count) {
    source.fail("", fmt::format("the file is cut short, or not an STL file: it announces {} "
                                "triangles, which take {} bytes, but has {} bytes",
                                count, header_size + facet_size * count, bytes.size()));
  }
  if (count > 700'000'000) source.fail("", "more than 700 million triangles");
  std::vector<Vec3> corners;
  corners.reserve(3 * count);
  for (std::size_t f = 0; f < count; ++f) {
    for (int k = 0; k < 3; ++k) {
      float p[3];
      std::memcpy(p, bytes.data() + header_size + facet_size * f + 12 + 12 * k, 12);
      corners.emplace_back(p[0], p[1], p[2]);
      if (!corners.back().allFinite()) {
        source.fail(fmt::format("triangle {} (counted from 1)", f + 1),
                    fmt::format("corner ({}, {}, {}) is not finite", p[0], p[1], p[2]));
      }
    }
  }
  return welded(std::move(corners));
}

/// The words of the format may be written in capitals.
bool is_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

TriangleMesh read_text(const Source& source) {
  Lines lines(source);
  std::vector<Vec3> corners;
  bool in_solid = false, in_facet = false;
  std::size_t facet_begin = 0;
  while (std::optional<std::string_view> line = lines.next()) {
    Words words(*line, source, lines.number());
    const std::string_view keyword = words.next();
    if (keyword.empty() || is_word(keyword, "outer") || is_word(keyword, "endloop")) continue;
    if (is_word(keyword, "solid")) {
      in_solid = true;
    } else if (is_word(keyword, "facet")) {
      if (in_facet) words.fail("a facet begins before the last one has ended");
      in_facet = true;
      facet_begin = corners.size();
    } else if (is_word(keyword, "vertex")) {
      if (!in_facet) words.fail("a vertex outside of a facet");
      const double x = words.number("x");
      const double y = words.number("y");
      const double z = words.number("z");
      corners.emplace_back(x, y, z);
    } else if (is_word(keyword, "endfacet")) {
      if (!in_facet || corners.size() - facet_begin != 3) {
        words.fail(
            fmt::format("a facet has {} corners, but needs 3", corners.size() - facet_begin));
      }
      in_facet = false;
    } else if (is_word(keyword, "endsolid") || is_word(keyword, "end")) {
      if (in_facet) words.fail("the solid ends within a facet");
      in_solid = false;
    } else {
      words.fail(fmt::format("{} is not a word of an STL file", quoted(keyword)));
    }
  }
  if (in_facet || in_solid) {
    source.fail(fmt::format("line {}", lines.number()),
                fmt::format("the file is cut short: it ends before '{}'",
                            in_facet ? "endfacet" : "endsolid"));
  }
  return welded(std::move(corners));
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= header_size &&
         bytes.size() == header_size + facet_size * std::size_t{announced_facets(bytes)};
}

TriangleMesh read_stl(const Source& source) {
  // Binary files may begin with "solid" too; text never holds a 0.
  Words words(source.bytes.substr(0, 200), source, 1);
  const bool text = is_word(words.next(), "solid") && !is_binary_stl(source.bytes) &&
                    source.bytes.substr(0, 4096).find('\0') == std::string_view::npos;
  return text ? read_text(source) : read_binary(source);
}

}  // namespace fracbench::formats
