#pragma once

#include <string_view>

namespace fracbench {

/// Told how far a piece of work has come. This base class ignores it.
class Progress {
 public:
  virtual ~Progress() = default;

  /// `fraction` of the work named `what` is done, in [0, 1]. May be called from one thread at a
  /// time.
  virtual void update(std::string_view what, double fraction) {
    (void)what;
    (void)fraction;
  }
};

}  // namespace fracbench
