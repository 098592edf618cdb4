#include "geometry/write_mesh.h"

#include <fmt/format.h>

#include "core/atomic_file.h"
#include "core/error.h"
#include "geometry/formats/writers.h"

namespace fracbench {

namespace {

using Encoder = std::string (*)(std::span<const formats::Part>);

Encoder choose_encoder(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (extension == ".obj") return formats::obj_bytes;
  if (extension == ".ply") return formats::ply_bytes;
  if (extension == ".stl") return formats::stl_bytes;
  if (extension == ".glb") return formats::glb_bytes;
  throw InputError(
      fmt::format("cannot write '{}': '{}' is not a mesh format that is written; "
                  "choose .obj, .ply, .stl or .glb",
                  file.string(), extension));
}

}  // namespace

void write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh) {
  const formats::Part part{.name = "mesh", .mesh = &mesh};
  write_file_atomically(file, choose_encoder(file)({&part, 1}));
}

void write_fragments(const std::filesystem::path& file, const Fragments& fragments) {
  const Encoder encode = choose_encoder(file);
  std::vector<formats::Part> parts;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const Fragment& fragment = fragments[i];
    formats::Part part{.name = fmt::format("fragment_{:03}", i), .mesh = &fragment.mesh};
    part.face_properties = {{"part", {}}, {"original_face", {}}, {"interface", {}}};
    for (std::size_t f = 0; f < fragment.mesh.faces.size(); ++f) {
      const FragmentFace face = f < fragment.faces.size() ? fragment.faces[f] : FragmentFace{};
      part.fracture.push_back(face.is_fracture());
      part.face_properties[0].values.push_back(static_cast<std::int32_t>(i));
      part.face_properties[1].values.push_back(face.original_face);
      part.face_properties[2].values.push_back(face.interface);
    }
    parts.push_back(std::move(part));
  }
  write_file_atomically(file, encode(parts));
}

}  // namespace fracbench
