#include "core/collision_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kFile = "impulses.json";
constexpr const char* kForm =
    R"({"impulses": [{"point": [x, y, z], "direction": [x, y, z], "magnitude": N s}]})";

Json read_json(const fs::path& file) {
  std::ifstream stream(file);
  Json json = Json::parse(stream, nullptr, false);
  if (json.is_discarded() || !json.is_object()) {
    throw InputError(
        fmt::format("{}: is no JSON object; it must look like {}", file.string(), kForm));
  }
  return json;
}

Vec3 vector_in(const Json& impulse, const char* name, const std::string& where) {
  const auto found = impulse.find(name);
  const bool good = found != impulse.end() && found->is_array() && found->size() == 3 &&
                    std::ranges::all_of(*found, [](const Json& x) { return x.is_number(); });
  if (!good) throw InputError(fmt::format("{}: '{}' must be three numbers", where, name));
  return {(*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>()};
}

std::vector<GivenImpulse> impulses_in(const Json& json, const std::string& where) {
  const auto found = json.is_object() ? json.find("impulses") : json.end();
  if (!json.is_object() || found == json.end() || !found->is_array() || found->empty()) {
    throw InputError(fmt::format("{}: there are no impulses; it must look like {}", where, kForm));
  }
  std::vector<GivenImpulse> impulses;
  for (const Json& item : *found) {
    const std::string place = fmt::format("{}: impulse {}", where, impulses.size());
    if (!item.is_object()) throw InputError(fmt::format("{} is no object", place));
    GivenImpulse impulse{.point = vector_in(item, "point", place),
                         .direction = vector_in(item, "direction", place),
                         .magnitude = 0};
    const auto magnitude = item.find("magnitude");
    if (magnitude != item.end() && magnitude->is_number()) impulse.magnitude = *magnitude;
    if (!(impulse.magnitude > 0) || !std::isfinite(impulse.magnitude)) {
      throw InputError(fmt::format("{}: 'magnitude' must be above 0 N s", place));
    }
    if (!(impulse.direction.norm() > 0) || !impulse.direction.allFinite()) {
      throw InputError(fmt::format("{}: 'direction' must not be 0", place));
    }
    impulse.direction.normalize();
    impulses.push_back(impulse);
  }
  std::ranges::stable_sort(impulses, std::greater(), &GivenImpulse::magnitude);
  return impulses;
}

}  // namespace

std::vector<fs::path> StoredCollision::files() const {
  std::vector<fs::path> list;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) list.push_back(entry.path());
  }
  std::ranges::sort(list);
  return list;
}

std::vector<StoredCollision> read_collision_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw InputError(
        fmt::format("{}: is no folder; it must hold a folder for each collision", folder.string()));
  }
  std::optional<Json> of_all;
  if (fs::exists(folder / kFile)) of_all = read_json(folder / kFile);
  std::vector<StoredCollision> collisions;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory()) continue;
    collisions.push_back(
        {.name = entry.path().filename().string(), .folder = entry.path(), .impulses = {}});
  }
  std::ranges::sort(collisions, {}, &StoredCollision::name);
  if (collisions.empty()) {
    throw InputError(
        fmt::format("{}: holds no folder; there must be one for each collision", folder.string()));
  }
  for (StoredCollision& collision : collisions) {
    const fs::path own = collision.folder / kFile;
    if (fs::exists(own)) {
      collision.impulses = impulses_in(read_json(own), own.string());
    } else if (of_all && of_all->contains(collision.name)) {
      collision.impulses =
          impulses_in(of_all->at(collision.name),
                      fmt::format("{}: '{}'", (folder / kFile).string(), collision.name));
    } else {
      throw InputError(fmt::format(
          "{}: there is no {} in it, and none beside it that names '{}'; it must look like {}",
          collision.folder.string(), kFile, collision.name, kForm));
    }
  }
  return collisions;
}

}  // namespace fracbench
