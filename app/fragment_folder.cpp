#include "app/fragment_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "geometry/components.h"
#include "geometry/read_mesh.h"
#include "geometry/write_mesh.h"

namespace fracbench {

namespace fs = std::filesystem;

namespace {

/// A new folder beside `folder`, removed again unless it was moved to its place.
class FolderInTheMaking {
 public:
  explicit FolderInTheMaking(const fs::path& folder)
      : place_(folder), making_(fmt::format("{}.part{}", folder.string(), ::getpid())) {
    fs::create_directories(making_);
  }
  ~FolderInTheMaking() {
    std::error_code ignored;
    fs::remove_all(making_, ignored);
  }
  FolderInTheMaking(const FolderInTheMaking&) = delete;
  FolderInTheMaking& operator=(const FolderInTheMaking&) = delete;

  const fs::path& path() const { return making_; }

  void move_to_its_place() const {
    const fs::path old = making_.string() + ".old";
    const bool replace = fs::exists(place_);
    if (replace) fs::rename(place_, old);
    fs::rename(making_, place_);
    if (replace) fs::remove_all(old);
  }

 private:
  fs::path place_;
  fs::path making_;
};

fs::path without_trailing_slash(const fs::path& folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

bool is_mesh_file(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return std::tolower(c); });
  return extension == ".obj" || extension == ".ply" || extension == ".stl" || extension == ".off";
}

}  // namespace

void require_usable_folder(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) {
    throw InputError(fmt::format("--out {}: is a file; name a folder", folder.string()));
  }
  if (!fs::is_empty(folder) && !fs::exists(folder / kResultFile)) {
    throw InputError(
        fmt::format("--out {}: holds files that are no earlier result of this command (there is no "
                    "{}); name a new or empty folder",
                    folder.string(), kResultFile));
  }
}

void write_fragment_folder(const fs::path& folder, const Fragments& fragments,
                           const std::string& format,
                           const std::map<std::string, nlohmann::ordered_json>& documents) try {
  require_usable_folder(folder);
  const FolderInTheMaking making(without_trailing_slash(folder));
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    write_mesh(making.path() / fmt::format("fragment_{:03}.{}", k, format), fragments[k].mesh);
  }
  if (!fragments.empty()) write_fragments(making.path() / "fragments.glb", fragments);
  for (const auto& [name, document] : documents) {
    write_file_atomically(making.path() / name, document.dump(2) + "\n");
  }
  making.move_to_its_place();
} catch (const fs::filesystem_error& error) {
  throw InputError(
      fmt::format("--out {}: cannot be written: {}", folder.string(), error.code().message()));
}

std::vector<TriangleMesh> read_fragment_meshes(const fs::path& path) {
  std::vector<TriangleMesh> meshes;
  if (fs::is_directory(path)) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(path)) {
      if (entry.is_regular_file() && is_mesh_file(entry.path())) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    for (const fs::path& file : files) meshes.push_back(read_mesh(file));
    if (meshes.empty()) {
      throw InputError(
          fmt::format("{}: no OBJ, PLY, STL or OFF file in this folder; name the "
                      "folder that holds one mesh for each fragment",
                      path.string()));
    }
    return meshes;
  }
  for (MeshPart& part : solid_components(read_mesh(path))) meshes.push_back(std::move(part.mesh));
  return meshes;
}

}  // namespace fracbench
