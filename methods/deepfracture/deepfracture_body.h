#pragma once

#include <memory>
#include <span>

#include "core/breakable.h"
#include "core/target.h"
#include "methods/deepfracture/patterns.h"
#include "methods/deepfracture/settings.h"
#include "neural/field_decoder.h"
#include "neural/model.h"

namespace fracbench::deepfracture {

/// A target with the model that was trained for it, and maybe for others.
class DeepFractureBody : public Breakable {
 public:
  /// `agreement` is that of each of the model's shapes, or empty where it was not measured. Throws
  /// InputError where the target is none of the model's shapes, or the model has no output of the
  /// wanted resolution or takes another number of impulses.
  DeepFractureBody(const Target& target, Settings settings, neural::Model model,
                   std::vector<Agreement> agreement);

  /// Algorithm 2 of the paper, lines 6 and 7: prediction, segmentation, cut.
  std::vector<Piece> fracture(const Impact& impact, Context& context) const override;

  /// Writes model.fracbench (neural::write_model) and agreement.fracbench.
  void save(const std::filesystem::path& folder) const override;

  const neural::Model& model() const { return model_; }
  /// Of each of the model's shapes.
  const std::vector<Agreement>& agreement() const { return agreement_; }

 private:
  void report_training(Context& context) const;
  void note_other_rows(std::size_t row, std::span<const float> impulses, Context& context) const;
  VoxelGrid<float> predict(const Impact& impact, Context& context) const;

  TriangleMesh mesh_;
  Settings settings_;
  neural::Model model_;
  std::size_t shape_;  ///< the target among the model's shapes
  std::vector<Agreement> agreement_;
  std::unique_ptr<neural::FieldDecoder> decoder_;
};

/// Reads what `save` wrote. Throws InputError where it is damaged or does not fit the target.
std::unique_ptr<DeepFractureBody> load_body(const std::filesystem::path& folder,
                                            const Target& target, Settings settings);

}  // namespace fracbench::deepfracture
