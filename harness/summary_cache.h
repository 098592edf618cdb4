#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "harness/cell_summary.h"
#include "harness/kept_lines.h"

namespace fracbench {

/// What the records of one results folder say, without reading them again: a record takes
/// milliseconds to open and verify, its summary microseconds. The summaries lie in
/// summaries/ beside the records (KeptLines), a line for each record, with what the file system
/// knew of the record when it was verified (inode, size, times of change). A record that was
/// touched since is read and verified anew.
///
/// From any number of threads and processes.
class SummaryCache {
 public:
  /// Reads what is there. `folder` is the results folder.
  explicit SummaryCache(const std::filesystem::path& folder);
  /// Writes what was learned. May wait some milliseconds, see add.
  ~SummaryCache();
  SummaryCache(const SummaryCache&) = delete;
  SummaryCache& operator=(const SummaryCache&) = delete;

  /// Of a record whose bytes are verified, now or since they last changed. Throws DataError where
  /// it is missing or damaged, or is the record of another cell.
  CellSummary read(const std::filesystem::path& record);
  /// The same for who asks once: it is not kept in memory any longer.
  CellSummary take(const std::filesystem::path& record);

  /// The summary of a record that the caller has just written.
  void add(const std::filesystem::path& record, const CellSummary& summary);

 private:
  /// What tells that a file is as it was.
  struct Stamp {
    std::uint64_t inode = 0;
    std::uint64_t size = 0;
    std::int64_t modified = 0;  ///< ns
    std::int64_t changed = 0;   ///< ns
    bool operator==(const Stamp&) const = default;
  };
  struct Known {
    Stamp stamp;
    CellSummary summary;
  };
  struct Added {
    std::filesystem::path record;
    Stamp stamp;
    std::string result_digest;
    std::string json;
    std::chrono::steady_clock::time_point when;
  };

  CellSummary find(const std::filesystem::path& record, bool keep);
  static Stamp stamp_of(const std::filesystem::path& record);
  void add(const std::filesystem::path& record, const Stamp& stamp, const CellSummary& summary);
  void write_settled();

  std::mutex mutex_;  // guards all that follows
  KeptLines lines_;
  std::map<std::string, Known> known_;
  std::vector<Added> added_;
};

}  // namespace fracbench
