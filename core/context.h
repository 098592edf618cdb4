#pragma once

#include <stop_token>
#include <string>

#include "core/error.h"
#include "core/progress.h"
#include "core/random.h"
#include "core/stage_timer.h"

namespace fracbench {

/// What a method or scene is handed for its work. Nothing in it outlives the call.
struct Context {
  Random& random;      ///< the only source of chance
  StageTimer& timer;   ///< where the time goes, by named stage
  Progress& progress;  ///< told how far long work has come
  std::stop_token stop = {};
  int threads = 1;
  std::string device = "cpu";

  /// Throws Cancelled when the work was asked to stop; long loops call it at least twice a second.
  void stop_if_asked() const {
    if (stop.stop_requested()) throw Cancelled();
  }
};

}  // namespace fracbench
