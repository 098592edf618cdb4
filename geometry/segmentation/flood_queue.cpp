#include "geometry/segmentation/flood_queue.h"

#include <algorithm>
#include <bit>

namespace fracbench {
namespace {

/// Stable; a bucket holds a few entries where values differ, and is in order already where they do
/// not.
void sort_by_value(std::vector<FloodQueue::Entry>& entries) {
  const auto less = [](const FloodQueue::Entry& a, const FloodQueue::Entry& b) {
    return a.value < b.value;
  };
  constexpr std::size_t few = 24;
  if (entries.size() > few) {
    if (!std::is_sorted(entries.begin(), entries.end(), less)) {
      std::stable_sort(entries.begin(), entries.end(), less);
    }
    return;
  }
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const FloodQueue::Entry entry = entries[i];
    std::size_t to = i;
    for (; to > 0 && entry.value < entries[to - 1].value; --to) entries[to] = entries[to - 1];
    entries[to] = entry;
  }
}

}  // namespace

FloodQueue::FloodQueue(float low, float high, std::size_t expected_entries) : low_(low) {
  // About eight entries a bucket: one cache line.
  const std::size_t buckets =
      std::bit_ceil(std::clamp<std::size_t>(expected_entries / 8, 256, std::size_t{1} << 20));
  heads_.assign(buckets, -1);
  last_bucket_ = static_cast<float>(buckets - 1);
  if (high > low) scale_ = last_bucket_ / (high - low);
}

std::int32_t FloodQueue::add_block(std::int32_t bucket) {
  std::int32_t block;
  if (free_blocks_.empty()) {
    block = static_cast<std::int32_t>(blocks_.size());
    blocks_.emplace_back();
  } else {
    block = free_blocks_.back();
    free_blocks_.pop_back();
  }
  blocks_[block].count = 0;
  blocks_[block].next = heads_[bucket];
  heads_[bucket] = block;
  return block;
}

void FloodQueue::push_at_once(Entry entry) {
  const bool is_level_empty = level_next_ == level_.size();
  if (is_level_empty) {
    level_.clear();
    level_next_ = 0;
  }
  if (entry.value == (is_level_empty ? last_ : level_[level_next_].value)) {
    level_.push_back(entry);
    return;
  }
  early_.push_back({entry, order_++});
  std::push_heap(early_.begin(), early_.end());
}

bool FloodQueue::advance() {
  const auto buckets = static_cast<std::int32_t>(heads_.size());
  do {
    if (++current_ >= buckets) {
      current_ = buckets - 1;
      return false;
    }
  } while (heads_[current_] < 0);

  run_.clear();
  next_ = 0;
  for (std::int32_t block = heads_[current_]; block >= 0; block = blocks_[block].next) {
    const Block& full = blocks_[block];
    for (int i = full.count - 1; i >= 0; --i) run_.push_back(full.entries[i]);
    free_blocks_.push_back(block);
  }
  heads_[current_] = -1;
  std::reverse(run_.begin(), run_.end());
  sort_by_value(run_);
  return true;
}

FloodQueue::Entry FloodQueue::take_first() {
  enum { run, early, level } from = run;
  float lowest = 0;
  bool found = false;
  if (next_ < run_.size()) {
    lowest = run_[next_].value;
    found = true;
  }
  if (!early_.empty() && (!found || early_.front().entry.value < lowest)) {
    lowest = early_.front().entry.value;
    from = early;
    found = true;
  }
  if (level_next_ < level_.size() && (!found || level_[level_next_].value < lowest)) from = level;
  if (from == run) return run_[next_++];
  if (from == level) return level_[level_next_++];
  const Entry entry = early_.front().entry;
  std::pop_heap(early_.begin(), early_.end());
  early_.pop_back();
  return entry;
}

}  // namespace fracbench
