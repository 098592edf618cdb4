#pragma once

#include "methods/method.h"

namespace fracbench {

/// Pre-fracture by the fracture modes of Sellan et al. 2023, "Breaking Good: Fracture modes for
/// realtime destruction" (ACM TOG 42(1)): the worst-case ways in which the shape comes apart, found
/// once; an impact only chooses which of their pieces part. See docs/methods/modes.md.
class ModesMethod : public Method {
 public:
  MethodInfo info() const override;
  OptionsSchema options() const override;
  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                     const Options& options, Context& context) const override;
  std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                  const Options& options) const override;
  std::vector<ValidationCase> validation() const override;
};

}  // namespace fracbench
