#include <bit>
#include <charconv>
#include <cstring>

#include "geometry/formats/writers.h"
#include "geometry/measures.h"

namespace fracbench::formats {

namespace {

static_assert(std::endian::native == std::endian::little, "binary files are little endian");

void append_number(std::string& text, double value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append_number(std::string& text, std::int64_t value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

template <typename T>
void append_raw(std::string& bytes, const T& value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

struct Size {
  std::size_t vertices = 0, faces = 0;
};

Size total_size(std::span<const Part> parts) {
  Size size;
  for (const Part& part : parts) {
    size.vertices += part.mesh->vertices.size();
    size.faces += part.mesh->faces.size();
  }
  return size;
}

}  // namespace

std::string obj_bytes(std::span<const Part> parts) {
  std::string text = "# written by fracbench\n";
  const Size size = total_size(parts);
  text.reserve(size.vertices * 64 + size.faces * 24);
  std::int64_t first = 1;
  for (const Part& part : parts) {
    text += "g " + part.name + "\n";
    for (const Vec3& v : part.mesh->vertices) {
      text += 'v';
      for (int i = 0; i < 3; ++i) {
        text += ' ';
        append_number(text, v[i]);
      }
      text += '\n';
    }
    for (const Face& face : part.mesh->faces) {
      text += 'f';
      for (const std::int32_t v : face) {
        text += ' ';
        append_number(text, first + v);
      }
      text += '\n';
    }
    first += static_cast<std::int64_t>(part.mesh->vertices.size());
  }
  return text;
}

std::string ply_bytes(std::span<const Part> parts) {
  const Size size = total_size(parts);
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment written by fracbench\n";
  bytes += "element vertex " + std::to_string(size.vertices) +
           "\nproperty double x\nproperty double y\nproperty double z\n";
  bytes +=
      "element face " + std::to_string(size.faces) + "\nproperty list uchar int vertex_indices\n";
  if (!parts.empty()) {
    for (const Part::FaceProperty& property : parts[0].face_properties) {
      bytes += "property int " + property.name + "\n";
    }
  }
  bytes += "end_header\n";
  bytes.reserve(bytes.size() + 24 * size.vertices + 25 * size.faces);
  for (const Part& part : parts) {
    for (const Vec3& v : part.mesh->vertices) {
      for (int i = 0; i < 3; ++i) append_raw(bytes, v[i]);
    }
  }
  std::int32_t first = 0;
  for (const Part& part : parts) {
    for (std::size_t f = 0; f < part.mesh->faces.size(); ++f) {
      append_raw(bytes, std::uint8_t{3});
      for (const std::int32_t v : part.mesh->faces[f]) append_raw(bytes, first + v);
      for (const Part::FaceProperty& property : part.face_properties) {
        append_raw(bytes, property.values[f]);
      }
    }
    first += static_cast<std::int32_t>(part.mesh->vertices.size());
  }
  return bytes;
}

std::string stl_bytes(std::span<const Part> parts) {
  // Not "solid" in front: some readers would take that for text.
  std::string bytes = "binary STL written by fracbench";
  bytes.resize(80, ' ');
  const Size size = total_size(parts);
  append_raw(bytes, static_cast<std::uint32_t>(size.faces));
  bytes.reserve(84 + 50 * size.faces);
  for (const Part& part : parts) {
    for (std::size_t f = 0; f < part.mesh->faces.size(); ++f) {
      const auto append = [&](const Vec3& v) {
        for (int i = 0; i < 3; ++i) append_raw(bytes, static_cast<float>(v[i]));
      };
      append(area_vector2(*part.mesh, f).stableNormalized());
      for (int k = 0; k < 3; ++k) append(part.mesh->corner(f, k));
      append_raw(bytes, std::uint16_t{0});
    }
  }
  return bytes;
}

}  // namespace fracbench::formats
