#pragma once

#include "methods/method.h"

namespace fracbench {

/// The baseline of all that learns: the fragments of the training collision whose impulse is
/// nearest, as they are. See docs/methods/nearest-pattern.md.
class NearestPatternMethod : public Method {
 public:
  MethodInfo info() const override;
  OptionsSchema options() const override;
  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                     const Options& options, Context& context) const override;
  std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                  const Options& options) const override;
};

}  // namespace fracbench
