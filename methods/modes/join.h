#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace fracbench::modes {

/// Sets of the numbers 0 ... n - 1 that grow by being joined.
class Joined {
 public:
  explicit Joined(std::int64_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  void join(std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

  /// The set of each number: 0, 1, ... in the order of their smallest members.
  std::vector<std::int32_t> labels() {
    count_ = 0;
    std::vector<std::int32_t> label(parent_.size());
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      const std::int32_t r = root(static_cast<std::int32_t>(i));
      label[i] = r == static_cast<std::int32_t>(i) ? count_++ : label[r];
    }
    return label;
  }

  /// Number of sets at the last call of labels().
  std::int32_t count() const { return count_; }

 private:
  std::int32_t root(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::vector<std::int32_t> parent_;
  std::int32_t count_ = 0;
};

}  // namespace fracbench::modes
