#include "geometry/read_mesh.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.h"
#include "geometry/formats/readers.h"

namespace fracbench {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::string_view what,
                       std::string_view way_out) {
  throw InputError(fmt::format("cannot read '{}': {}; {}", file.string(), what, way_out));
}

std::string read_bytes(const std::filesystem::path& file) {
  const auto system_reason = [](int error) { return std::generic_category().message(error); };
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    const int error = errno;
    fail(file, system_reason(error),
         error == ENOENT || error == ENOTDIR ? "check the name and the folder"
         : error == EACCES                   ? "make the file readable for you"
                                             : "check the file");
  }
  struct Closer {
    int descriptor;
    ~Closer() { ::close(descriptor); }
  } const closer{descriptor};

  struct ::stat status = {};
  if (::fstat(descriptor, &status) != 0) fail(file, system_reason(errno), "check the file");
  if (S_ISDIR(status.st_mode)) fail(file, "it is a folder", "name a mesh file in it");
  std::string bytes;
  std::size_t size = 0;
  // One byte more than the size that is known shows the end of the file without another turn.
  bytes.resize(static_cast<std::size_t>(std::max<::off_t>(status.st_size, 0)) + 1);
  for (;;) {
    const ::ssize_t count = ::read(descriptor, bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(file, system_reason(errno), "check the file and its disk");
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
    if (size == bytes.size()) bytes.resize(2 * size);
  }
  bytes.resize(size);
  return bytes;
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

/// The first word of a text, after comments; for formats that begin with a keyword.
std::string_view first_word(const formats::Source& source) {
  formats::Lines lines(source);
  std::optional<formats::Words> words = lines.next_words();
  return words ? words->next() : std::string_view();
}

using Reader = TriangleMesh (*)(const formats::Source&);

Reader choose_reader(const std::filesystem::path& file, const formats::Source& source) {
  const std::string_view bytes = source.bytes;
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return formats::read_ply;
  if (formats::is_binary_stl(bytes)) return formats::read_stl;
  const std::string extension = lower_extension(file);
  if (extension == ".obj") return formats::read_obj;
  if (extension == ".ply") return formats::read_ply;
  if (extension == ".off") return formats::read_off;
  if (extension == ".stl") return formats::read_stl;
  const std::string_view word = first_word(source);
  if (word == "OFF" || word == "COFF" || word == "NOFF" || word == "CNOFF") {
    return formats::read_off;
  }
  if (word == "solid") return formats::read_stl;
  if (word == "v" || word == "mtllib" || word == "o" || word == "g") return formats::read_obj;
  fail(file, "this is no mesh in a known format", "known are OBJ, STL, PLY and OFF");
}

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& file) {
  return mesh_from_bytes(read_bytes(file), file);
}

TriangleMesh mesh_from_bytes(std::string_view bytes, const std::filesystem::path& name) {
  // Some editors begin a text with a mark of its encoding, which is no part of the first word.
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  if (bytes.empty()) fail(name, "the file is empty", "export the mesh again");
  const formats::Source source{bytes, name.string()};
  TriangleMesh mesh = choose_reader(name, source)(source);
  if (mesh.empty()) source.fail("", "it holds no faces", "name a file that holds a mesh");
  return mesh;
}

}  // namespace fracbench
