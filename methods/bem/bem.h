#pragma once

#include "methods/method.h"

namespace fracbench {

/// Brittle fracture by boundary elements: cracks start where the stress on the surface exceeds the
/// strength and run through the body by their stress intensities (Hahn and Wojtan, "High-resolution
/// brittle fracture simulation with boundary elements", 2015; "Fast approximations for boundary
/// element based brittle fracture simulation", 2016). The reference of the DeepFracture paper.
class BemMethod : public Method {
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
