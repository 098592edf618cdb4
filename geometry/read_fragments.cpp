#include "geometry/read_fragments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "geometry/components.h"
#include "geometry/read_mesh.h"

namespace fracbench {

namespace fs = std::filesystem;

bool is_mesh_file(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return std::tolower(c); });
  return extension == ".obj" || extension == ".ply" || extension == ".stl" || extension == ".off";
}

std::vector<fs::path> mesh_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file(error) && is_mesh_file(entry.path())) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

std::vector<TriangleMesh> read_fragment_meshes(const fs::path& path) {
  std::vector<TriangleMesh> meshes;
  if (!fs::is_directory(path)) {
    for (MeshPart& part : solid_components(read_mesh(path))) meshes.push_back(std::move(part.mesh));
    return meshes;
  }
  for (const fs::path& file : mesh_files(path)) meshes.push_back(read_mesh(file));
  if (meshes.empty()) {
    throw InputError(
        fmt::format("{}: no OBJ, PLY, STL or OFF file in this folder; name the folder that holds "
                    "one mesh for each fragment",
                    path.string()));
  }
  return meshes;
}

}  // namespace fracbench
