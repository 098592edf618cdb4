// Mesh files: the first byte chooses the format, the rest is the file.

#include <array>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/read_mesh.h"
#include "scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fracbench;
  constexpr std::array kNames = {"a.obj", "a.off", "a.ply", "a.stl"};
  if (size == 0) return 0;
  try {
    const TriangleMesh mesh =
        mesh_from_bytes(fuzz::text_of(data + 1, size - 1), kNames[data[0] % kNames.size()]);
    for (const Face& face : mesh.faces) {
      for (const std::int32_t v : face) {
        if (v < 0 || static_cast<std::size_t>(v) >= mesh.vertices.size()) __builtin_trap();
      }
    }
    if (mesh.faces.size() < 200) check_mesh(mesh);
  } catch (const InputError&) {
  }
  return 0;
}
