#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/breakable.h"
#include "core/target.h"
#include "geometry/measures.h"
#include "geometry/surface_distance.h"
#include "methods/modes/cut_body.h"
#include "methods/modes/fragment_meshes.h"
#include "methods/modes/impact_projection.h"
#include "methods/modes/strength.h"

namespace fracbench::modes {

/// What is known of a body once its modes are: its pieces, and how they answer to impulses.
struct ModelData {
  CutBody cut;  ///< the cells are the atomic pieces
  ImpactProjection projection;
  double typical_jump = 0;                ///< see typical_jump(), m/s per N s
  std::vector<double> mode_energies;      ///< per mode
  std::vector<std::int32_t> mode_pieces;  ///< per mode, how many pieces it has
  std::string settings;                   ///< the options that it was made with, as text
};

/// A prepared body. Immutable: all fragments of all impacts share it.
class Model {
 public:
  Model(const Target& target, ModelData data, const Strength& strength);

  const TriangleMesh& body() const { return body_; }
  const Material& material() const { return material_; }
  const SurfaceDistance& surface() const { return surface_; }
  const ModelData& data() const { return data_; }
  const Strength& strength() const { return strength_; }
  FragmentSource fragments() const { return {data_.cut, faces_}; }

 private:
  TriangleMesh body_;
  Material material_;
  SurfaceDistance surface_;
  ModelData data_;
  Strength strength_;
  CellFaces faces_;
};

/// Writes `model.fracbench` below a folder (see core/array_file.h; the names are those of the
/// members). Throws InputError.
void save_model(const std::filesystem::path& folder, const Model& model);

/// Reads what save_model wrote for the same target and settings. Throws InputError where that is
/// missing, damaged, or belongs to another target or other settings.
ModelData load_model(const std::filesystem::path& folder, const Target& target,
                     const std::string& settings);

/// The body that a model describes, or what some of its pieces hold together.
class ModesBody : public Breakable {
 public:
  /// The whole body.
  explicit ModesBody(std::shared_ptr<const Model> model);
  /// The fragment of these pieces (ascending), in `box`.
  ModesBody(std::shared_ptr<const Model> model, std::vector<std::int32_t> pieces,
            const BoundingBox& box);

  /// Throws InputError where an impulse is not finite or off the surface.
  std::vector<Piece> fracture(const Impact& impact, Context& context) const override;

  /// Writes the model; only the whole body can be saved (else InputError).
  void save(const std::filesystem::path& folder) const override;

  const Model& model() const { return *model_; }

 private:
  void check(const Impact& impact) const;
  /// For each of the pieces its group.
  std::vector<std::int32_t> groups_after(const Impact& impact) const;
  std::vector<Piece> pieces_of(const std::vector<std::int32_t>& group, int threads) const;

  std::shared_ptr<const Model> model_;
  std::vector<std::int32_t> pieces_;
  bool whole_ = true;
  BoundingBox box_;
};

}  // namespace fracbench::modes
