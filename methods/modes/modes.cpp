#include "methods/modes/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"
#include "geometry/measures.h"
#include "methods/modes/atomic_pieces.h"
#include "methods/modes/cage.h"
#include "methods/modes/fracture_modes.h"
#include "methods/modes/model.h"
#include "methods/modes/validation/impact_cases.h"
#include "methods/modes/validation/solver_cases.h"

namespace fracbench {

namespace {

using modes::CageKind;

/// What is decided when a body is prepared.
struct Settings {
  modes::CageOptions cage;
  modes::ModesOptions modes;
  double minimum_volume = 0;  ///< of the body's volume
  std::int32_t fragments = 0;

  Settings(const Options& options, const Material& material) {
    cage.kind = kind_of(options.text("cage"));
    cage.target_faces = options.integer("cage_faces");
    cage.target_tets = options.integer("tets");
    modes.count = static_cast<int>(options.integer("modes"));
    modes.dimension = static_cast<int>(options.integer("dimension"));
    modes.elastic = options.flag("elastic");
    modes.jump_threshold = options.number("jump_threshold");
    modes.material = material;
    minimum_volume = options.number("minimum_volume");
    fragments = static_cast<std::int32_t>(options.integer("fragments"));
    if (modes.dimension == 2) {
      throw InputError("modes: option 'dimension' is 2, must be 1 or 3");
    }
    if (modes.elastic && modes.dimension != 3) {
      throw InputError(
          "modes: option 'elastic' needs 'dimension' 3, which is 1; elastic "
          "displacements are vectors");
    }
    use_named(options.text("settings"));
  }

  /// All of it, as text: equal settings prepare equal models.
  std::string text() const {
    nlohmann::ordered_json json;
    json["cage"] = static_cast<int>(cage.kind);
    json["cage_faces"] = cage.target_faces;
    json["tets"] = cage.target_tets;
    json["modes"] = modes.count;
    json["dimension"] = modes.dimension;
    json["elastic"] = modes.elastic;
    json["jump_threshold"] = modes.jump_threshold;
    json["minimum_volume"] = minimum_volume;
    json["fragments"] = fragments;
    json["density"] = modes.material.density;
    if (modes.elastic) {
      json["young_modulus"] = modes.material.young_modulus;
      json["poisson_ratio"] = modes.material.poisson_ratio;
      json["strength"] = modes.material.strength;
    }
    return json.dump();
  }

 private:
  static CageKind kind_of(const std::string& name) {
    if (name == "shape") return CageKind::shape;
    return name == "offset" ? CageKind::offset : CageKind::automatic;
  }

  /// The settings of the DeepFracture paper's comparison.
  void use_named(const std::string& name) {
    if (name == "own") return;
    cage.kind = CageKind::offset;
    modes.dimension = 3;
    modes.elastic = false;
    const modes::NamedCage& named = name == "paper" ? modes::kPaperCage : modes::kPaperFineCage;
    cage.target_faces = named.cage_faces;
    if (modes.count < named.least_modes || modes.count > named.most_modes) {
      throw InputError(fmt::format("modes: settings '{}' have {} to {} modes, option 'modes' is {}",
                                   name, named.least_modes, named.most_modes, modes.count));
    }
  }
};

modes::Strength strength_of(const Options& options) {
  return {.raw = options.text("threshold") == "raw",
          .raw_threshold = options.number("raw_threshold")};
}

std::unique_ptr<Breakable> body_of(const Target& target, modes::ModelData data,
                                   const Options& options) {
  return std::make_unique<modes::ModesBody>(
      std::make_shared<modes::Model>(target, std::move(data), strength_of(options)));
}

}  // namespace

MethodInfo ModesMethod::info() const {
  MethodInfo info;
  info.name = "modes";
  info.summary = "fracture modes: worst-case pre-fracture, projected on by impacts in milliseconds";
  info.publications = {{.key = "sellan2023",
                        .authors =
                            "Silvia Sellán and Jack Luong and Leticia Mattos Da Silva and Aravind "
                            "Ramakrishnan and Yuchuan Yang and Alec Jacobson",
                        .title = "Breaking Good: Fracture Modes for Realtime Destruction",
                        .journal = "ACM Transactions on Graphics",
                        .volume = "42",
                        .number = "1",
                        .year = 2023,
                        .doi = "10.1145/3549540"}};
  info.shape_type = "cutting";
  info.refracture = true;
  return info;
}

OptionsSchema ModesMethod::options() const {
  return {
      {.name = "settings",
       .fallback = std::string("own"),
       .unit = "",
       .summary = "paper: the comparison's offset cage of 6000 faces, 5 to 60 modes; paper-fine: "
                  "13000 faces, 10 modes; own: the options below",
       .choices = {"own", "paper", "paper-fine"}},
      {.name = "modes",
       .fallback = std::int64_t{10},
       .unit = "",
       .summary = "number of fracture modes",
       .minimum = 1,
       .maximum = 1000},
      {.name = "dimension",
       .fallback = std::int64_t{3},
       .unit = "",
       .summary = "components of the displacement of a tet: 3, or 1 (faster)",
       .minimum = 1,
       .maximum = 3},
      {.name = "elastic",
       .fallback = false,
       .unit = "",
       .summary = "displacements linear in each tet, with their elastic energy"},
      {.name = "cage",
       .fallback = std::string("automatic"),
       .unit = "",
       .summary = "what is filled with tets: the shape itself, an offset surface around it, or the "
                  "shape where it has no more than cage_faces faces",
       .choices = {"automatic", "shape", "offset"}},
      {.name = "cage_faces",
       .fallback = std::int64_t{6000},
       .unit = "",
       .summary = "faces of the cage",
       .minimum = 20,
       .maximum = 100000},
      {.name = "tets",
       .fallback = std::int64_t{0},
       .unit = "",
       .summary =
           "about as many tets, where their quality does not need more; 0: as few as it allows",
       .minimum = 0,
       .maximum = 1e6},
      {.name = "jump_threshold",
       .fallback = 0.1,
       .unit = "",
       .summary = "tets are joined across faces at which a mode jumps by less (unit box, unit mass "
                  "norm)",
       .minimum = 0},
      {.name = "minimum_volume",
       .fallback = 1e-3,
       .unit = "of the body's volume",
       .summary = "smaller atomic pieces join the neighbour with the largest shared face",
       .minimum = 0,
       .maximum = 0.5},
      {.name = "fragments",
       .fallback = std::int64_t{0},
       .unit = "",
       .summary =
           "at most so many atomic pieces: those that part least in the modes are joined; 0: "
           "as many as the modes give",
       .minimum = 0,
       .maximum = 100000},
      {.name = "threshold",
       .fallback = std::string("calibrated"),
       .unit = "",
       .summary =
           "when pieces part: calibrated: breaks where the scene's break test does; raw: at a "
           "difference of velocity of raw_threshold",
       .choices = {"calibrated", "raw"}},
      {.name = "raw_threshold",
       .fallback = 0.02,
       .unit = "m/s",
       .summary = "pieces stay joined where their velocities differ by less; for threshold = raw",
       .minimum = 0},
  };
}

std::unique_ptr<Breakable> ModesMethod::prepare(const Target& target, const LearningData&,
                                                const Options& options, Context& context) const {
  const Settings settings(options, target.material);
  modes::ModelData data;
  data.settings = settings.text();
  modes::TetMesh tets;
  {
    const auto stage = context.timer.stage("cage");
    tets = modes::tetrahedralise_cage(target.mesh, settings.cage, context);
  }
  modes::FractureModes found;
  {
    const auto stage = context.timer.stage("modes");
    found = modes::compute_modes(tets, settings.modes, context);
  }
  data.mode_energies = found.energies;
  data.mode_pieces = found.piece_counts;
  modes::AtomicPieces pieces;
  {
    const auto stage = context.timer.stage("cut");
    const modes::MergeOptions merge{.minimum_volume = settings.minimum_volume * volume(target.mesh),
                                    .wanted = settings.fragments};
    pieces = modes::atomic_pieces(target.mesh, tets, found, merge, context);
  }
  const auto stage = context.timer.stage("projection");
  data.projection = modes::project_impacts(tets, pieces, context);
  data.typical_jump = modes::typical_jump(data.projection, target.mesh, target.material.density);
  data.cut = std::move(pieces.cut);
  return body_of(target, std::move(data), options);
}

std::unique_ptr<Breakable> ModesMethod::load(const std::filesystem::path& folder,
                                             const Target& target, const Options& options) const {
  const Settings settings(options, target.material);
  return body_of(target, modes::load_model(folder, target, settings.text()), options);
}

std::vector<ValidationCase> ModesMethod::validation() const {
  std::vector<ValidationCase> cases = modes::impact_validation_cases();
  std::ranges::move(modes::solver_validation_cases(), std::back_inserter(cases));
  return cases;
}

}  // namespace fracbench
