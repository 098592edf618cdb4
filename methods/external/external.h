#pragma once

#include "methods/method.h"

namespace fracbench {

/// A program of any kind: it is called with a folder that holds the body and the impact, and a
/// folder for the fragments. See docs/add-a-method.md.
class ExternalMethod : public Method {
 public:
  MethodInfo info() const override;
  OptionsSchema options() const override;
  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                     const Options& options, Context& context) const override;
  std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                  const Options& options) const override;
  std::vector<std::filesystem::path> files(const Options& options) const override;
};

}  // namespace fracbench
