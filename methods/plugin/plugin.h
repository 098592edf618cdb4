#pragma once

#include "methods/method.h"

namespace fracbench {

/// A method of fracture in a shared library, which is loaded at run time and called through the C
/// functions of fracbench_plugin.h.
class PluginMethod : public Method {
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
