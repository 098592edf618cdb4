#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/plan.h"
#include "harness/runner.h"
#include "harness/user_cache.h"

namespace fracbench {

/// The collisions that methods learn from, on the disk, by content: another results folder or
/// another suite that wants the same ones takes them from here. See docs/cache.md. Below the folder
///   collisions/<key>/manifest.json   method, options and shape: one entry, as it is listed
///   collisions/<key>/<cell>.h5       a record (record.h) by the key of its cell
/// Any number of processes may use one folder.
class CollisionStore {
 public:
  explicit CollisionStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Below user_cache_folder().
  static std::optional<CollisionStore> of_user();

  /// Measures cells of the plan, which must outlive it: reads what is there, else calls `execute`
  /// and keeps what it returns, unless the cell failed. Where another process is measuring the same
  /// cell, waits for that one. A record that is damaged is made anew, with a message on standard
  /// error; where the folder cannot be written, nothing is kept.
  ExecuteCell through(const Plan& plan, ExecuteCell execute) const;

  /// All entries, by key. With `verify` every record is read and its digests are checked.
  std::vector<CacheEntry> list(bool verify = false) const;

  /// Removes an entry. False where it is not there or cannot be removed.
  bool remove(const std::string& key) const;

  /// Removes its damaged records, and keeps the others.
  void remove_damaged(const std::string& key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace fracbench
