#pragma once

#include "methods/method.h"

namespace fracbench {

/// Fragments that some tool has made for the impulses of the scenario family `imported`
/// (docs/import.md): they are scored, compared and learned from like those of any method.
class ImportMethod : public Method {
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
