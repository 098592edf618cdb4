#include "harness/summary_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.h"
#include "harness/cell_summary_json.h"
#include "harness/data_file.h"
#include "harness/record.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kLinesAtATime = 256;

// Times of files go in ticks of some milliseconds. What changes twice within one looks as it was;
// so a line is written only when a later change must show.
constexpr auto kTick = std::chrono::milliseconds(20);

/// Reports believe nothing that cannot be verified, and the digests are over whole records.
CellSummary read_verified(const fs::path& record) {
  if (!fs::exists(record)) throw DataError("is missing");
  const DataTree tree = read_hdf5(record);
  require_intact(tree);
  CellSummary summary = to_summary(tree);
  if (summary.key != record.stem().string()) throw DataError("is the record of another cell");
  return summary;
}

}  // namespace

SummaryCache::SummaryCache(const fs::path& folder) : lines_(folder / "summaries") {
  lines_.read([this](const Json& line) {
    const Json& stamp = line.at("record");
    Known known{.stamp = {.inode = stamp.at(0),
                          .size = stamp.at(1),
                          .modified = stamp.at(2),
                          .changed = stamp.at(3)},
                .summary = cell_summary_from_json(line.at("cell"))};
    known.summary.result_digest = line.at("result_digest");
    std::string key = known.summary.key;
    // A record that was made again stands in several lines; the youngest is of the file that is.
    Known& kept = known_[std::move(key)];
    if (known.stamp.changed >= kept.stamp.changed) kept = std::move(known);
  });
}

SummaryCache::~SummaryCache() {
  const std::scoped_lock lock(mutex_);
  if (added_.empty()) return;
  std::this_thread::sleep_until(added_.back().when + kTick);
  write_settled();
}

CellSummary SummaryCache::read(const fs::path& record) { return find(record, true); }

CellSummary SummaryCache::take(const fs::path& record) { return find(record, false); }

CellSummary SummaryCache::find(const fs::path& record, bool keep) {
  const Stamp stamp = stamp_of(record);
  {
    const std::scoped_lock lock(mutex_);
    const auto known = known_.find(record.stem().string());
    if (known != known_.end() && known->second.stamp == stamp) {
      if (keep) return known->second.summary;
      CellSummary summary = std::move(known->second.summary);
      known_.erase(known);
      return summary;
    }
  }
  CellSummary summary = read_verified(record);
  add(record, stamp, summary);
  return summary;
}

void SummaryCache::add(const fs::path& record, const CellSummary& summary) {
  add(record, stamp_of(record), summary);
}

void SummaryCache::add(const fs::path& record, const Stamp& stamp, const CellSummary& summary) {
  if (stamp == Stamp()) return;
  std::string json;
  try {
    json = to_json(summary).dump();
  } catch (const Json::exception&) {
    return;  // text that is no UTF-8
  }
  const std::scoped_lock lock(mutex_);
  if (!lines_.writable()) return;
  added_.push_back({record, stamp, summary.result_digest, std::move(json), Clock::now()});
  if (added_.size() % kLinesAtATime == 0) write_settled();
}

SummaryCache::Stamp SummaryCache::stamp_of(const fs::path& record) {
  struct stat status = {};
  if (::stat(record.c_str(), &status) != 0) return {};
  const auto nanoseconds = [](const timespec& time) {
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
  };
  return {.inode = static_cast<std::uint64_t>(status.st_ino),
          .size = static_cast<std::uint64_t>(status.st_size),
          .modified = nanoseconds(status.st_mtim),
          .changed = nanoseconds(status.st_ctim)};
}

void SummaryCache::write_settled() {
  std::vector<std::string> lines;
  std::vector<Added> fresh;
  const auto now = Clock::now();
  for (Added& item : added_) {
    if (now - item.when < kTick) {
      fresh.push_back(std::move(item));
    } else if (stamp_of(item.record) == item.stamp) {
      const Stamp& s = item.stamp;
      lines.push_back(fmt::format(R"({{"record":[{},{},{},{}],"result_digest":"{}","cell":{}}})",
                                  s.inode, s.size, s.modified, s.changed, item.result_digest,
                                  item.json));
    }
  }
  added_ = std::move(fresh);
  lines_.append(lines);
}

}  // namespace fracbench
