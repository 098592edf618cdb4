#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/finding.h"
#include "core/progress.h"
#include "core/random.h"
#include "core/stage_timer.h"

namespace fracbench {

/// The device that is always there.
inline constexpr std::string_view kProcessor = "cpu";

/// What a method or scene is handed for its work. Nothing in it outlives the call.
struct Context {
  Random& random;      ///< the only source of chance
  StageTimer& timer;   ///< where the time goes, by named stage
  Progress& progress;  ///< told how far long work has come
  std::stop_token stop = {};
  int threads = 1;
  std::string device = std::string(kProcessor);  ///< or "cuda": for methods that can use one
  /// What a break should be remembered with beside its pieces, a line each; part of the record, so
  /// the same lines for the same seed. Null: nobody listens.
  std::vector<std::string>* notes = nullptr;
  /// Numbers to remember with it, likewise; of two of one name the later one counts.
  std::vector<Finding>* findings = nullptr;
  /// A folder for pictures of the break, in files whose names start with the method's; empty: none.
  /// What is broken does not depend on it.
  std::filesystem::path pictures = {};
  /// A folder for the checkpoints of long work on one body: what was written there is there again
  /// when the same work is begun anew after an interruption. Empty: none. The result does not
  /// depend on it.
  std::filesystem::path checkpoints = {};

  void note(std::string line) const {
    if (notes) notes->push_back(std::move(line));
  }

  void found(Finding finding) const {
    if (!findings) return;
    std::erase_if(*findings, [&](const Finding& f) { return f.name == finding.name; });
    findings->push_back(std::move(finding));
  }

  /// Throws Cancelled when the work was asked to stop; long loops call it at least twice a second.
  void stop_if_asked() const {
    if (stop.stop_requested()) throw Cancelled();
  }
};

}  // namespace fracbench
