#include "harness/collision_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "core/atomic_file.h"
#include "core/digest.h"
#include "core/error.h"
#include "harness/claim.h"
#include "harness/data_file.h"
#include "harness/record.h"
#include "harness/record_store.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kManifest = "manifest.json";
constexpr auto kWaitInterval = std::chrono::milliseconds(100);

/// What the collisions of one method with one shape have in common.
struct Kind {
  std::string key;
  Json manifest;
};

Kind kind_of(const Plan& plan, const Cell& cell) {
  const PlannedShape& shape = plan.shapes[cell.shape];
  const PlannedMethod& method = plan.methods[cell.method];
  const Json options = method.options.to_json();
  Digest digest;
  for (const std::string& text : {method.info.name, options.dump(), shape.shape.name}) {
    digest.add(text);
  }
  digest.add(shape.digest);
  return {.key = digest.hex(),
          .manifest = {
              {"method", method.info.name}, {"options", options}, {"shape", shape.shape.name}}};
}

std::string damage_of(const fs::path& file) {
  try {
    read_record_file(file);
    return "";
  } catch (const DataError& error) {
    return error.what();
  }
}

/// The cells of one plan, measured through the store.
class Through {
 public:
  Through(fs::path folder, const Plan& plan, ExecuteCell execute)
      : folder_(std::move(folder)), plan_(plan), execute_(std::move(execute)) {}

  Record measure(const Cell& cell, Progress& progress, const std::stop_token& stop) {
    const Kind kind = kind_of(plan_, cell);
    const fs::path entry = folder_ / kind.key;
    const fs::path file = entry / (cell.key + ".h5");
    const bool usable = open(entry, kind.manifest);
    std::optional<Claim> claim;
    while (true) {
      if (auto found = read(file)) return std::move(*found);
      if (!usable || claim) break;
      if (auto taken = Claim::try_take(file.string() + ".lock")) {
        claim.emplace(std::move(*taken));
        continue;  // it may have been finished between our look and our claim
      }
      progress.update("waiting for another process that measures this collision", 0);
      if (stop.stop_requested()) throw Cancelled();
      std::this_thread::sleep_for(kWaitInterval);
    }
    Record made = execute_(cell, progress, stop);
    if (usable) keep(made, file);
    return made;
  }

 private:
  /// Makes the entry, or notes that it is used. Whether it can be written.
  bool open(const fs::path& entry, const Json& manifest) {
    const std::scoped_lock lock(mutex_);
    const auto known = usable_.find(entry);
    if (known != usable_.end()) return known->second;
    bool& usable = usable_[entry];
    try {
      fs::create_directories(entry);
      // Written anew each time: its age is when the entry was last used.
      write_file_atomically(entry / kManifest, manifest.dump(2) + "\n");
      usable = true;
    } catch (const std::exception& error) {
      say_once(fmt::format("collisions are not kept: {}; name another folder in FRACBENCH_CACHE",
                           error.what()));
    }
    return usable;
  }

  static std::optional<Record> read(const fs::path& file) {
    if (!fs::exists(file)) return std::nullopt;
    try {
      return read_record_file(file);
    } catch (const DataError& error) {
      warn_of_cache(
          fmt::format("the collision {:.12} is made anew: {}", file.stem().string(), error.what()));
      std::error_code ignored;
      fs::remove(file, ignored);
      return std::nullopt;
    }
  }

  void keep(const Record& record, const fs::path& file) {
    const CellStatus status = record.outcome.status;
    if (status != CellStatus::ok && status != CellStatus::unbroken) return;
    try {
      write_file_atomically(file, to_hdf5(to_tree(record), is_packed_array));
    } catch (const InputError& error) {
      const std::scoped_lock lock(mutex_);
      say_once(fmt::format("a collision is not kept: {}", error.what()));
    }
  }

  /// For who holds the mutex.
  void say_once(const std::string& text) {
    if (!std::exchange(said_, true)) warn_of_cache(text);
  }

  const fs::path folder_;
  const Plan& plan_;
  const ExecuteCell execute_;
  std::mutex mutex_;                 // guards all that follows
  std::map<fs::path, bool> usable_;  ///< entries that were opened
  bool said_ = false;
};

}  // namespace

std::optional<CollisionStore> CollisionStore::of_user() {
  const auto folder = user_cache_folder();
  if (!folder) return std::nullopt;
  return CollisionStore(*folder);
}

ExecuteCell CollisionStore::through(const Plan& plan, ExecuteCell execute) const {
  auto through = std::make_shared<Through>(folder_ / "collisions", plan, std::move(execute));
  return [through](const Cell& cell, Progress& progress, const std::stop_token& stop) {
    return through->measure(cell, progress, stop);
  };
}

std::vector<CacheEntry> CollisionStore::list(bool verify) const {
  std::vector<CacheEntry> entries;
  std::error_code error;
  for (const auto& folder : fs::directory_iterator(folder_ / "collisions", error)) {
    if (!folder.is_directory()) continue;
    CacheEntry entry{.key = folder.path().filename().string(),
                     .method = "?",
                     .shape = "?",
                     .collisions = 0,
                     .used = last_written(folder.path() / kManifest)};
    try {
      std::ifstream stream(folder.path() / kManifest);
      const Json manifest = Json::parse(stream);
      entry.method = manifest.at("method");
      entry.shape = manifest.at("shape");
    } catch (const nlohmann::json::exception& bad) {
      entry.complaint = fmt::format("'{}': {}", kManifest, bad.what());
    }
    for (const fs::path& file : record_files(folder.path())) {
      entry.bytes += fs::file_size(file, error);
      ++*entry.collisions;
      if (!verify || !entry.complaint.empty()) continue;
      if (const std::string damage = damage_of(file); !damage.empty()) {
        entry.complaint = fmt::format("'{}' {}", file.filename().string(), damage);
      }
    }
    entries.push_back(std::move(entry));
  }
  std::ranges::sort(entries, {}, &CacheEntry::key);
  return entries;
}

bool CollisionStore::remove(const std::string& key) const {
  return remove_cache_entry(folder_ / "collisions" / key);
}

void CollisionStore::remove_damaged(const std::string& key) const {
  for (const fs::path& file : record_files(folder_ / "collisions" / key)) {
    std::error_code ignored;
    if (!damage_of(file).empty()) fs::remove(file, ignored);
  }
}

}  // namespace fracbench
