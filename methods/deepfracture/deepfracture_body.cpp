#include "methods/deepfracture/deepfracture_body.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "core/array_file.h"
#include "core/error.h"
#include "core/impulse_vector.h"
#include "core/random.h"
#include "geometry/measures.h"

namespace fracbench::deepfracture {

namespace {

constexpr ArrayFileKind kAgreementKind{.format = "fracbench agreement", .version = 2};
constexpr const char* kModelFile = "model.fracbench";
constexpr const char* kAgreementFile = "agreement.fracbench";

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The place of the target among the shapes of a model that fits.
std::size_t check_model(const neural::Model& model, const Target& target,
                        const Settings& settings) {
  const auto refuse = [](std::string why) { throw InputError("deepfracture: the model " + why); };
  const auto shape = find_shape(model.shapes, shape_digest(target.mesh));
  if (!shape) {
    refuse(fmt::format("was trained for another mesh ('{}') than '{}'", names_of(model.shapes),
                       target.name));
  }
  const auto& list = model.network.resolutions;
  if (std::ranges::find(list, settings.resolution) == list.end()) {
    refuse(fmt::format("has outputs of resolution {}, wanted is {}; set option 'resolution'",
                       fmt::join(list, ", "), settings.resolution));
  }
  if (model.rows() == 0) refuse("has an empty codebook: it was not trained to the end of an epoch");
  if (model.shapes.size() > 1 && !settings.quantise) {
    refuse(
        fmt::format("knows {} shapes, which only the rows of its codebook tell apart; set option "
                    "'quantise' to true",
                    model.shapes.size()));
  }
  return *shape;
}

}  // namespace

DeepFractureBody::DeepFractureBody(const Target& target, Settings settings, neural::Model model,
                                   std::vector<Agreement> agreement)
    : mesh_(target.mesh),
      settings_(std::move(settings)),
      model_(std::move(model)),
      shape_(check_model(model_, target, settings_)),
      agreement_(std::move(agreement)),
      decoder_(neural::make_decoder(model_)) {}

/// Says how well the training went: its loss, what exact fields give back (the ceiling) and what
/// decoded ones do.
void DeepFractureBody::report_training(Context& context) const {
  std::vector<double> losses;
  for (const neural::EpochRecord& epoch : model_.epochs) losses.push_back(epoch.loss);
  context.found({"deepfracture_training_loss", std::move(losses)});
  context.found({"deepfracture_shapes", {static_cast<double>(model_.shapes.size())}});
  if (agreement_.empty() || agreement_[shape_].round_trip.empty()) return;
  const Agreement& here = agreement_[shape_];
  context.note(fmt::format(
      "deepfracture: {} training patterns at r = {}: adjusted Rand index {:.3f} from exact fields "
      "(the ceiling), {:.3f} decoded",
      here.round_trip.size(), settings_.resolution, mean(here.round_trip), mean(here.decoded)));
  context.found({"deepfracture_round_trip", here.round_trip});
  context.found({"deepfracture_decoded", here.decoded});
}

/// Says how often another random code would have chosen another row: the ablation of the random
/// codes. Takes nothing from the random numbers that the prediction is made with.
void DeepFractureBody::note_other_rows(std::size_t row, std::span<const float> impulses,
                                       Context& context) const {
  constexpr int kCodes = 64;
  Random random = context.random.fork("further codes");
  int others = 0;
  for (int n = 0; n < kCodes; ++n)
    others += neural::nearest_row(model_, shape_, impulses, random) != row;
  context.note(fmt::format("deepfracture: {} of {} further random codes choose another row", others,
                           kCodes));
  context.found({"deepfracture_other_rows", {static_cast<double>(others) / kCodes}});
}

VoxelGrid<float> DeepFractureBody::predict(const Impact& impact, Context& context) const {
  const std::vector<float> impulses =
      impulse_vector(impact, model_.shapes[shape_].scaling, model_.network.features);
  std::vector<float> code;
  if (model_.network.decoder == neural::Decoder::pix2pix) {
    // Goes by the impulses alone.
  } else if (settings_.quantise) {
    const std::size_t row = neural::nearest_row(model_, shape_, impulses, context.random);
    context.note(fmt::format("deepfracture: row {} of {} of the codebook, training pattern {}",
                             row + 1, model_.rows(), model_.codebook_pattern[row] + 1));
    note_other_rows(row, impulses, context);
    code.assign(model_.row(row).begin(), model_.row(row).end());
  } else {
    code = neural::encode(model_.siren, impulses);
    const auto segment = neural::random_segment_code(model_.network.segment_code, context.random);
    code.insert(code.end(), segment.begin(), segment.end());
  }
  return decoder_->decode({code, impulses}, settings_.resolution, context.threads);
}

std::vector<Piece> DeepFractureBody::fracture(const Impact& impact, Context& context) const {
  report_training(context);
  VoxelGrid<float> field;
  {
    const auto stage = context.timer.stage("prediction");
    field = predict(impact, context);
  }
  context.stop_if_asked();
  return reconstruct(mesh_, field, settings_.reconstruct, context);
}

void DeepFractureBody::save(const std::filesystem::path& folder) const {
  neural::write_model(folder / kModelFile, model_);
  ArrayFile file;
  for (std::size_t s = 0; s < agreement_.size(); ++s) {
    file.reals[fmt::format("{}/round_trip", s)] = agreement_[s].round_trip;
    file.reals[fmt::format("{}/decoded", s)] = agreement_[s].decoded;
  }
  write_array_file(folder / kAgreementFile, file, kAgreementKind);
}

std::unique_ptr<DeepFractureBody> load_body(const std::filesystem::path& folder,
                                            const Target& target, Settings settings) {
  ArrayFile file = read_array_file(folder / kAgreementFile, kAgreementKind);
  neural::Model model = neural::read_model(folder / kModelFile);
  std::vector<Agreement> agreement;
  for (std::size_t s = 0; s < model.shapes.size() && !file.reals.empty(); ++s) {
    agreement.push_back({.round_trip = file.reals[fmt::format("{}/round_trip", s)],
                         .decoded = file.reals[fmt::format("{}/decoded", s)]});
    if (agreement.back().round_trip.size() != agreement.back().decoded.size()) {
      throw InputError(fmt::format("'{}' is damaged", (folder / kAgreementFile).string()));
    }
  }
  return std::make_unique<DeepFractureBody>(target, std::move(settings), std::move(model),
                                            std::move(agreement));
}

}  // namespace fracbench::deepfracture
