#pragma once

#include "core/context.h"
#include "methods/bem/validation/smooth_bodies.h"

namespace fracbench::bem {

/// What a computation without chance needs.
class PlainContext {
 public:
  explicit PlainContext(int threads = 2) : context_{random_, timer_, progress_} {
    context_.threads = threads;
  }
  Context& get() { return context_; }

 private:
  Random random_{1};
  StageTimer timer_;
  Progress progress_;
  Context context_;
};

}  // namespace fracbench::bem
