#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/options.h"
#include "core/target.h"
#include "methods/method.h"

namespace fracbench {

/// What the checks are made with.
struct CheckSubject {
  const Method& method;
  Options options;
  const Target& target;
  double impulse = 2e5;     ///< of the blows, N s
  double memory_mb = 4000;  ///< MiB that preparing and breaking the body may take
  int threads = 1;
};

namespace conformance {

constexpr std::uint64_t kSeed = 1;

/// A method at work on its subject, which must outlive it.
class Bench {
 public:
  explicit Bench(const CheckSubject& subject) : subject_(subject) {}

  std::unique_ptr<Breakable> prepare(const std::stop_token& stop = {}) const;
  std::vector<Piece> blow(const Breakable& body, const Impact& impact, std::uint64_t seed = kSeed,
                          const std::stop_token& stop = {}) const;
  /// A blow along the inward normal at the middle of a face: the n-th of a few that are spread over
  /// the surface.
  Impact impact(int n, double factor = 1) const;
  /// The pieces of the first of a few blows that breaks the body, or of the last.
  std::vector<Piece> broken() const;

  const CheckSubject& subject() const { return subject_; }

 private:
  Context context_of(Random& random, StageTimer& timer, Progress& progress,
                     const std::stop_token& stop) const;

  const CheckSubject& subject_;
};

}  // namespace conformance
}  // namespace fracbench
