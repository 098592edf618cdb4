#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fracbench {

/// A priority queue on (value, order of insertion), exactly, for values that mostly grow from pop
/// to pop: entries wait unsorted in buckets of nearly equal value, and a bucket is sorted when its
/// turn comes. Values below the last one popped are allowed and come out at once. The idea is the
/// hierarchical queue of Meyer and Beucher ("Morphological segmentation", 1990), without its
/// rounding of values to one queue each.
class FloodQueue {
 public:
  struct Entry {
    float value;
    std::uint32_t item;
  };

  /// Buckets divide [low, high] into equal parts; values beyond either end are allowed.
  FloodQueue(float low, float high, std::size_t expected_entries);

  void push(Entry entry) {
    const std::int32_t bucket = bucket_of(entry.value);
    if (bucket > current_) {
      store(bucket, entry);
    } else {
      push_at_once(entry);
    }
  }

  /// False where the queue is empty.
  bool pop(Entry& entry) {
    if (next_ == run_.size() && level_next_ == level_.size() && early_.empty() && !advance()) {
      return false;
    }
    entry = take_first();
    last_ = entry.value;
    return true;
  }

  /// An entry that will be popped soon, `ahead` places from now, for prefetching; may be any.
  const Entry* upcoming(std::size_t ahead) const {
    return next_ + ahead < run_.size() ? &run_[next_ + ahead] : nullptr;
  }

 private:
  /// One cache line of a bucket's list.
  struct alignas(64) Block {
    Entry entries[7];
    std::int32_t count;
    std::int32_t next;  ///< block that was filled before this one; -1: none
  };
  struct EarlyEntry {
    Entry entry;
    std::uint64_t order;
    bool operator<(const EarlyEntry& other) const {  // for a heap with the smallest on top
      if (entry.value != other.entry.value) return entry.value > other.entry.value;
      return order > other.order;
    }
  };

  std::int32_t bucket_of(float value) const {
    const float scaled = (value - low_) * scale_;
    if (!(scaled > 0)) return 0;
    return scaled < last_bucket_ ? static_cast<std::int32_t>(scaled)
                                 : static_cast<std::int32_t>(last_bucket_);
  }
  void store(std::int32_t bucket, Entry entry) {
    std::int32_t block = heads_[bucket];
    if (block < 0 || blocks_[block].count == 7) block = add_block(bucket);
    Block& open = blocks_[block];
    open.entries[open.count++] = entry;
  }
  std::int32_t add_block(std::int32_t bucket);
  void push_at_once(Entry entry);
  bool advance();
  Entry take_first();

  float low_ = 0;
  float scale_ = 1;
  float last_bucket_ = 0;
  float last_ = 0;  ///< value popped last
  std::int32_t current_ = -1;
  std::vector<std::int32_t> heads_;  ///< by bucket: its newest block, -1: none
  std::vector<Block> blocks_;
  std::vector<std::int32_t> free_blocks_;

  // The entries of buckets up to current_, in three places. Of equal values, those in run_ are the
  // oldest and those in level_ the youngest.
  std::vector<Entry> run_;  ///< what was in the bucket when its turn came, sorted, from next_ on
  std::size_t next_ = 0;
  std::vector<Entry> level_;  ///< entries of one value, in order, from level_next_ on
  std::size_t level_next_ = 0;
  std::vector<EarlyEntry> early_;  ///< a heap
  std::uint64_t order_ = 0;
};

}  // namespace fracbench
