#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/context.h"
#include "core/target.h"
#include "harness/plan.h"

namespace fracbench {

/// A body that is ready to be broken.
struct Prepared {
  std::shared_ptr<const Target> target;
  std::shared_ptr<const Breakable> breakable;  ///< null where the method gave up
  std::string failure;                         ///< why, then
  double seconds = 0;                          ///< that it took, in whichever process made it
  bool fresh = false;                          ///< it was made or read by this call
};

/// Prepared bodies, made or taken from the user's store (prepared_store.h) once for a shape, a
/// method with its options and a material. For many
/// threads: who comes while a body is being made waits for it.
class BreakableCache {
 public:
  explicit BreakableCache(const Plan& plan) : plan_(plan) {}

  /// Equal for two cells of a plan that share a body.
  static std::string key(const Cell& cell, const Material& material);

  /// The body for this cell. Throws what Method::prepare throws, but for MethodFailure, which is
  /// kept like a body.
  Prepared get(const Cell& cell, Context& context);

 private:
  struct Entry {
    std::mutex mutex;
    bool made = false;
    Prepared prepared;
  };

  const Plan& plan_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Entry>> entries_;
};

/// The bodies that a plan needs, each as the first cell that breaks it.
std::vector<Cell> bodies_of(const Plan& plan);

}  // namespace fracbench
