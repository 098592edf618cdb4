#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "geometry/formats/polygons.h"
#include "geometry/formats/readers.h"

namespace fracbench::formats {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct TypeName {
  std::string_view name;
  Type type;
};
constexpr std::array<TypeName, 16> type_names = {{{"char", Type::int8},
                                                  {"uchar", Type::uint8},
                                                  {"short", Type::int16},
                                                  {"ushort", Type::uint16},
                                                  {"int", Type::int32},
                                                  {"uint", Type::uint32},
                                                  {"float", Type::float32},
                                                  {"double", Type::float64},
                                                  {"int8", Type::int8},
                                                  {"uint8", Type::uint8},
                                                  {"int16", Type::int16},
                                                  {"uint16", Type::uint16},
                                                  {"int32", Type::int32},
                                                  {"uint32", Type::uint32},
                                                  {"float32", Type::float32},
                                                  {"float64", Type::float64}}};

std::size_t size_of(Type type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

enum class Role { other, x, y, z, corners };

struct Property {
  std::string name;
  bool is_list = false;
  Type count_type = Type::uint8;  ///< of lists
  Type type = Type::float32;
  Role role = Role::other;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t end = 0;    ///< where the data begin
  std::size_t lines = 0;  ///< of the header
};

Type parse_type(Words& words) {
  const std::string_view word = words.next();
  const auto* found = std::find_if(type_names.begin(), type_names.end(),
                                   [&](const TypeName& t) { return t.name == word; });
  if (found == type_names.end()) words.fail(fmt::format("{} is not a type", quoted(word)));
  return found->type;
}

Property parse_property(Words& words, std::string_view element) {
  Property property;
  Words peek = words;
  if (peek.next() == "list") {
    words = peek;
    property.is_list = true;
    property.count_type = parse_type(words);
    if (property.count_type == Type::float32 || property.count_type == Type::float64) {
      words.fail("the length of a list must be a whole number");
    }
  }
  property.type = parse_type(words);
  property.name = words.next();
  if (property.name.empty()) words.fail("a property has no name");
  const std::string& name = property.name;
  if (element == "vertex" && !property.is_list) {
    if (name == "x") property.role = Role::x;
    if (name == "y") property.role = Role::y;
    if (name == "z") property.role = Role::z;
  }
  if (element == "face" && property.is_list &&
      (name == "vertex_indices" || name == "vertex_index")) {
    property.role = Role::corners;
  }
  return property;
}

Header parse_header(const Source& source) {
  Header header;
  // Only the header's own lines are told apart here, so the data's bytes do not matter.
  const std::size_t probe = std::min<std::size_t>(source.bytes.size(), 5);
  const bool line_feeds = source.bytes.substr(0, probe).find('\n') != std::string_view::npos;
  const char end_of_line = line_feeds ? '\n' : '\r';
  std::size_t position = 0;
  bool has_format = false;
  const auto has_role = [](const Element& e, Role role) {
    return std::any_of(e.properties.begin(), e.properties.end(),
                       [&](const Property& p) { return p.role == role; });
  };
  for (;;) {
    if (position >= source.bytes.size()) source.fail("", "the file ends within its header");
    const std::size_t end = std::min(source.bytes.find(end_of_line, position), source.bytes.size());
    ++header.lines;
    Words words(source.bytes.substr(position, end - position), source, header.lines);
    position = end + 1;
    const std::string_view keyword = words.next();
    if (header.lines == 1) {
      if (keyword != "ply") source.fail("line 1", "a PLY file begins with 'ply'");
      continue;
    }
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "end_header") break;
    if (keyword == "format") {
      const std::string_view name = words.next();
      if (name == "ascii") {
        header.encoding = Encoding::text;
      } else if (name == "binary_little_endian") {
        header.encoding = Encoding::little_endian;
      } else if (name == "binary_big_endian") {
        header.encoding = Encoding::big_endian;
      } else {
        words.fail(fmt::format("{} is not a PLY format", quoted(name)));
      }
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      element.name = words.next();
      const std::int64_t count = words.integer("the number of elements");
      if (count < 0) words.fail(fmt::format("the number of elements is {}, below 0", count));
      element.count = static_cast<std::size_t>(count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) words.fail("a property before the first element");
      Element& element = header.elements.back();
      Property property = parse_property(words, element.name);
      if (property.role != Role::other && has_role(element, property.role)) {
        words.fail(fmt::format("the property {} is there twice", quoted(property.name)));
      }
      element.properties.push_back(std::move(property));
    } else {
      words.fail(fmt::format("{} is not a word of a PLY header", quoted(keyword)));
    }
  }
  header.end = std::min(position, source.bytes.size());
  if (!has_format) source.fail("", "the header does not name its format");

  bool has_vertices = false, has_faces = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      if (has_vertices) source.fail("", "the element 'vertex' is there twice");
      has_vertices = true;
      for (const Role role : {Role::x, Role::y, Role::z}) {
        if (!has_role(element, role)) source.fail("", "the vertices have no x, y and z");
      }
    }
    if (element.name == "face") {
      if (has_faces) source.fail("", "the element 'face' is there twice");
      has_faces = true;
      if (!has_role(element, Role::corners)) source.fail("", "the faces have no 'vertex_indices'");
    }
    if (element.name == "tristrips") {
      source.fail("", "triangle strips are not read", "export the mesh with faces");
    }
    std::size_t least = 0;  // bytes that an element takes
    for (const Property& p : element.properties) {
      if (header.encoding == Encoding::text) {
        least = std::max<std::size_t>(2, least + 2);
      } else {
        least += size_of(p.is_list ? p.count_type : p.type);
      }
    }
    // The last line of a text may lack its end.
    const std::size_t left = source.bytes.size() - header.end + 1;
    if (element.count > 0 && least > 0 && element.count > left / least) {
      source.fail("", fmt::format("the file is cut short: {} elements '{}' take at least {} bytes "
                                  "each, but {} bytes follow the header",
                                  element.count, element.name, least, left - 1));
    }
  }
  if (!has_vertices || !has_faces)
    source.fail("", "the elements 'vertex' and 'face' must be there");
  return header;
}

/// Reads values in sequence from binary data.
class BinaryValues {
 public:
  BinaryValues(const Source& source, const Header& header)
      : source_(source),
        position_(header.end),
        swap_((header.encoding == Encoding::big_endian) !=
              (std::endian::native == std::endian::big)) {}

  void begin(const Element& element, std::size_t index) {
    element_ = &element;
    index_ = index;
  }

  double number(const Property&, Type type) {
    switch (type) {
      case Type::int8:
        return take<std::int8_t>();
      case Type::uint8:
        return take<std::uint8_t>();
      case Type::int16:
        return take<std::int16_t>();
      case Type::uint16:
        return take<std::uint16_t>();
      case Type::int32:
        return take<std::int32_t>();
      case Type::uint32:
        return take<std::uint32_t>();
      case Type::float32:
        return take<float>();
      default:
        return take<double>();
    }
  }

  [[noreturn]] void fail(std::string_view what) const {
    source_.fail(fmt::format("{} {} (counted from 0)", element_->name, index_), what);
  }

 private:
  template <typename T>
  T take() {
    if (source_.bytes.size() - position_ < sizeof(T)) {
      fail(fmt::format("the file is cut short: it ends here, where {} were announced",
                       element_->count));
    }
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), source_.bytes.data() + position_, sizeof(T));
    if (swap_) std::reverse(raw.begin(), raw.end());
    position_ += sizeof(T);
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }

  const Source& source_;
  std::size_t position_;
  bool swap_;
  const Element* element_ = nullptr;
  std::size_t index_ = 0;
};

/// Reads values in sequence from text, an element a line.
class TextValues {
 public:
  TextValues(const Source& source, const Header& header)
      : source_(source),
        header_lines_(header.lines),
        lines_(source, header.end),
        words_("", source, 0) {}

  void begin(const Element& element, std::size_t index) {
    for (;;) {
      const std::optional<std::string_view> line = lines_.next();
      if (!line) {
        source_.fail("", fmt::format("the file is cut short: {} of {} elements '{}' are there",
                                     index, element.count, element.name));
      }
      words_ = Words(*line, source_, header_lines_ + lines_.number());
      if (!words_.at_end()) return;
    }
  }

  double number(const Property& property, Type) {
    const std::string_view word = words_.next();
    if (word.empty()) fail(fmt::format("'{}' is missing", property.name));
    const std::optional<double> value = parse_number(word);
    if (!value) fail(fmt::format("'{}' is {}, not a number", property.name, quoted(word)));
    return *value;
  }

  [[noreturn]] void fail(std::string_view what) const { words_.fail(what); }

 private:
  const Source& source_;
  std::size_t header_lines_;
  Lines lines_;
  Words words_;
};

template <typename Values>
void read_element(const Element& element, std::size_t index, std::size_t vertex_count,
                  Values& values, Polygons& polygons) {
  values.begin(element, index);
  Vec3 position = Vec3::Zero();
  for (const Property& property : element.properties) {
    if (!property.is_list) {
      const double value = values.number(property, property.type);
      if (property.role == Role::other) continue;
      if (!std::isfinite(value)) {
        values.fail(fmt::format("{} is {}, not finite", property.name, value));
      }
      position[property.role == Role::x ? 0 : property.role == Role::y ? 1 : 2] = value;
      continue;
    }
    const double length = values.number(property, property.count_type);
    if (!(length >= 0) || length != std::floor(length)) {
      values.fail(fmt::format("the list '{}' has {} entries", property.name, length));
    }
    if (property.role == Role::corners && (length < 3 || length > most_corners)) {
      values.fail(fmt::format("a face has {} corners, but may have 3 to {}", length, most_corners));
    }
    for (double k = 0; k < length; ++k) {
      const double value = values.number(property, property.type);
      if (property.role != Role::corners) continue;
      if (!(value >= 0 && value < static_cast<double>(vertex_count)) ||
          value != std::floor(value)) {
        values.fail(fmt::format("vertex {} is out of range: there are {}, counted from 0", value,
                                vertex_count));
      }
      polygons.corners.push_back(static_cast<std::int32_t>(value));
    }
    if (property.role == Role::corners) polygons.ends.push_back(polygons.corners.size());
  }
  if (element.name == "vertex") polygons.vertices.push_back(position);
}

template <typename Values>
TriangleMesh read_data(const Source& source, const Header& header) {
  Values values(source, header);
  Polygons polygons;
  std::size_t vertex_count = 0;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      vertex_count = element.count;
      polygons.vertices.reserve(element.count);
    }
    if (element.name == "face") polygons.reserve_faces(element.count);
  }
  if (vertex_count > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    source.fail("", "more than 2147483647 vertices");
  }
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;  // takes no room in the file
    for (std::size_t i = 0; i < element.count; ++i) {
      read_element(element, i, vertex_count, values, polygons);
    }
  }
  return triangulated(std::move(polygons), source);
}

}  // namespace

TriangleMesh read_ply(const Source& source) {
  const Header header = parse_header(source);
  return header.encoding == Encoding::text ? read_data<TextValues>(source, header)
                                           : read_data<BinaryValues>(source, header);
}

}  // namespace fracbench::formats
