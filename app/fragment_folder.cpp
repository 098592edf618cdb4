#include "app/fragment_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
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

}  // namespace fracbench
