#pragma once

#include "methods/method.h"

namespace fracbench {

/// Learned brittle fracture (Huang and Kanai): see docs/methods/deepfracture.md.
class DeepFractureMethod : public Method {
 public:
  MethodInfo info() const override;
  OptionsSchema options() const override;
  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                     const Options& options, Context& context) const override;
  std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                  const Options& options) const override;
  bool learns(const Options& options) const override;
  std::optional<double> learning_seconds(const Options& options, std::size_t examples,
                                         const TrainingMachine& machine) const override;
  std::vector<std::filesystem::path> files(const Options& options) const override;
};

}  // namespace fracbench
