#include "training/training.h"

#include <gtest/gtest.h>
#include <torch/torch.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "neural/field_decoder.h"
#include "neural/pix2pix_decoder.h"
#include "tests/neural/made_up_data.h"
#include "training/implicit_network.h"
#include "training/pix2pix_network.h"
#include "training/voxel_network.h"

namespace fracbench::training {
namespace {

namespace fs = std::filesystem;
using neural::DataSet;
using neural::Model;
using neural::NetworkOptions;
using neural::Normalisation;
using neural::Statistics;

TrainingOptions small(int epochs) {
  return {.network = {.resolutions = {32}, .width = 1.0 / 32}, .epochs = epochs};
}

bool same(const Model& a, const Model& b) {
  return a.weights == b.weights && a.codebook == b.codebook && a.statistics == b.statistics &&
         std::ranges::equal(a.epochs, b.epochs, {}, &neural::EpochRecord::loss,
                            &neural::EpochRecord::loss);
}

class TrainingFolder : public ::testing::Test {
 protected:
  TrainingFolder() { fs::remove_all(folder_); }
  ~TrainingFolder() override { fs::remove_all(folder_); }
  const fs::path folder_ = fs::temp_directory_path() / ("training-" + std::to_string(::getpid()));
};

// One convolution of kernel 2 and a rearrangement in place of libtorch's own transposed one, which
// is asked in double precision, for which it does not call oneDNN (convolution_check.h says why).
TEST(VoxelNetwork, IsMadeOfTransposedConvolutions) {
  const NetworkOptions options{
      .resolutions = {32, 64}, .width = 1.0 / 32, .normalisation = Normalisation::group};
  Random random(5);
  VoxelNetwork network(options, random, torch::kCPU);
  std::map<std::string, torch::Tensor> w;
  for (const auto& [name, tensor] : network.weights()) w[name] = tensor.to(torch::kFloat64);
  const torch::Tensor code = torch::sin(torch::arange(options.code_size(), torch::kFloat32));
  torch::Tensor volume = torch::leaky_relu(
      torch::mv(w["linear.weight"], code.to(torch::kFloat64)) + w["linear.bias"], options.slope);
  volume = volume.reshape({1, -1, 8, 8, 8});
  const auto decoded = network.decode(code, true);
  int side = 8;
  for (const std::string block : {"block0", "block1"}) {
    volume = torch::conv_transpose3d(volume, w[block + ".weight"], w[block + ".bias"], 2, 1);
    volume = torch::leaky_relu(
        torch::group_norm(volume, 8, w[block + ".scale"], w[block + ".shift"], options.epsilon),
        options.slope);
    side *= 2;
    const torch::Tensor expected = torch::tanh(torch::conv_transpose3d(
        volume, w["head" + std::to_string(2 * side) + ".weight"], {}, 2, 1));
    const torch::Tensor& field = decoded.at(2 * side);
    EXPECT_LT((expected.reshape_as(field) - field).abs().max().item<double>(), 2e-6);
  }
}

struct Kind {
  Normalisation normalisation;
  Statistics statistics;
};

class PredictionTest : public ::testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, PredictionTest,
                         ::testing::Values(Kind{Normalisation::batch, Statistics::sample},
                                           Kind{Normalisation::batch, Statistics::running},
                                           Kind{Normalisation::batch, Statistics::reestimated},
                                           Kind{Normalisation::group, Statistics::sample}));

// The tolerance is that of sums of some thousand products in single precision, over three layers.
TEST_P(PredictionTest, OfTheFastDecoderIsThatOfLibtorch) {
  TrainingOptions options = small(2);
  options.network.resolutions = {32, 64};
  options.network.normalisation = GetParam().normalisation;
  options.network.statistics = GetParam().statistics;
  const DataSet data = test::made_up_data(2, {32, 64});
  const Model model = train(data, options, {});
  Random random(1);
  VoxelNetwork network(options.network, random, torch::kCPU);
  const torch::NoGradGuard none;
  for (auto& [name, tensor] : network.weights()) {
    tensor.copy_(tensor_of(model.weights.at(name), tensor.sizes()));
  }
  for (auto& [name, tensor] : network.statistics()) {
    const auto found = model.statistics.find(name);
    if (found != model.statistics.end()) tensor.copy_(tensor_of(found->second, tensor.sizes()));
  }
  const auto decoder = neural::make_decoder(model);
  const std::vector<float> row(model.row(0).begin(), model.row(0).end());
  const auto expected = network.decode(tensor_of(row, {static_cast<long>(row.size())}), false);
  for (const int r : {32, 64}) {
    const std::vector<float> wanted = values_of(expected.at(r));
    const auto field = decoder->decode({row, {}}, r, 1);
    double largest = 0;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      largest = std::max(largest, std::abs(static_cast<double>(wanted[k]) - field.values[k]));
    }
    EXPECT_LT(largest, 2e-5) << "r = " << r;
    for (const int threads : {2, 3, 40}) {
      EXPECT_EQ(decoder->decode({row, {}}, r, threads).values, field.values) << threads;
    }
  }
}

void copy_weights(const Model& model, Network& network) {
  const torch::NoGradGuard none;
  for (auto& [name, tensor] : network.weights()) {
    tensor.copy_(tensor_of(model.weights.at(name), tensor.sizes()));
  }
}

double largest_difference(const torch::Tensor& expected, const std::vector<float>& values) {
  return (expected.flatten() - tensor_of(values, {static_cast<long>(values.size())}))
      .abs()
      .max()
      .item<double>();
}

TEST(ImplicitDecoder, IsWhatLibtorchTrains) {
  const DataSet data = test::made_up_data(2, {32});
  TrainingOptions options = small(2);
  options.network.decoder = neural::Decoder::implicit;
  const Model model = train(data, options, {});
  Random random(1);
  ImplicitNetwork network(options.network, random, torch::kCPU);
  copy_weights(model, network);
  const std::vector<float> row(model.row(1).begin(), model.row(1).end());
  const auto field = neural::make_decoder(model)->decode({row, {}}, 32, 1);
  std::vector<float> places;
  for (int voxel = 0; voxel < 32 * 32 * 32; ++voxel) {
    const Vec3 p = field.position(voxel % 32, voxel / 32 % 32, voxel / 1024);
    for (int c = 0; c < 3; ++c) places.push_back(static_cast<float>(p[c]));
  }
  const torch::NoGradGuard none;
  const torch::Tensor expected = network.evaluate(tensor_of(row, {static_cast<long>(row.size())}),
                                                  tensor_of(places, {32 * 32 * 32, 3}));
  EXPECT_LT(largest_difference(expected, field.values), 1e-5);
}

TEST(Pix2pixDecoder, IsWhatLibtorchTrains) {
  const DataSet data = test::made_up_data(2, {32});
  TrainingOptions options = small(2);
  options.network.decoder = neural::Decoder::pix2pix;
  const Model model = train(data, options, {});
  Random random(1);
  Pix2pixNetwork network(options.network, random, torch::kCPU);
  copy_weights(model, network);
  const auto& impulses = data.patterns[1].impulses;
  const auto volume = neural::impulse_volume(impulses, data.shapes[0].scaling, 32);
  EXPECT_EQ(std::ranges::count_if(volume, [](float v) { return v != 0; }), 1);
  const torch::NoGradGuard none;
  const torch::Tensor expected = network.generate(tensor_of(volume, {32, 32, 32}));
  const auto field = neural::make_decoder(model)->decode({{}, impulses}, 32, 1);
  EXPECT_LT(largest_difference(expected, field.values), 2e-5);
}

TEST(Training, OfTheOtherDecodersMakesTheErrorOfTheFieldSmaller) {
  const DataSet data = test::made_up_data(3, {32});
  for (const neural::Decoder decoder : {neural::Decoder::implicit, neural::Decoder::pix2pix}) {
    TrainingOptions options = small(1);
    options.network.decoder = decoder;
    options.learning_rate = 0.001;
    const double early = pattern_losses(train(data, options, {}), data, 1)[0];
    options.epochs = 40;
    const double late = pattern_losses(train(data, options, {}), data, 1)[0];
    // A perceptron of 16 values a layer needs thousands of steps; it is seen here that it begins.
    EXPECT_LT(late, (decoder == neural::Decoder::implicit ? 0.8 : 0.3) * early)
        << to_string(decoder);
  }
}

// Overfitting, judged as the model predicts, not as it is trained.
TEST(Training, LearnsEightPatternsByHeart) {
  TrainingOptions options = small(200);
  options.network.width = 1.0 / 16;
  options.later_from = 130;
  const DataSet data = test::made_up_data(8, {32});
  const Model model = train(data, options, {});
  for (const double loss : pattern_losses(model, data, 1)) EXPECT_LT(loss, 1e-4);
  // It is the segment code and the impulse that tell the patterns apart.
  const auto decoder = neural::make_decoder(model);
  EXPECT_NE(decoder->decode({model.row(0), {}}, 32, 1).values,
            decoder->decode({model.row(1), {}}, 32, 1).values);
}

TEST(Training, LossFallsWithEveryObjectiveAndWithoutSegmentCodes) {
  const DataSet data = test::made_up_data(3, {32});
  for (const Loss loss : {Loss::l2, Loss::eikonal, Loss::dice}) {
    for (const SegmentCodes codes : {SegmentCodes::trained, SegmentCodes::random}) {
      TrainingOptions options = small(8);
      options.loss = loss;
      options.segment_codes = codes;
      const Model model = train(data, options, {});
      EXPECT_LT(model.epochs.back().loss, 0.7 * model.epochs.front().loss)
          << to_string(loss) << " " << to_string(codes);
    }
  }
}

TEST_F(TrainingFolder, GoesOnAfterTheLastEpochAsIfNothingHadHappened) {
  const DataSet data = test::made_up_data(3, {32});
  for (const auto& [statistics, decoder] : {std::pair{Statistics::sample, neural::Decoder::voxel},
                                            {Statistics::running, neural::Decoder::voxel},
                                            {Statistics::sample, neural::Decoder::implicit},
                                            {Statistics::sample, neural::Decoder::pix2pix}}) {
    TrainingOptions options = small(6);
    options.network.statistics = statistics;
    options.network.decoder = decoder;
    options.later_from = 4;
    const Model whole = train(data, options, {});
    fs::remove_all(folder_);
    std::stop_source source;
    int stopped_at = 0;
    const TrainingRun first{.checkpoints = folder_,
                            .stop = source.get_token(),
                            .progress = [&](int epoch, double, double) {
                              stopped_at = epoch;
                              if (epoch == 3) source.request_stop();
                            }};
    EXPECT_THROW(train(data, options, first), Cancelled);
    EXPECT_EQ(stopped_at, 3);
    int epochs = 0;
    const TrainingRun second{.checkpoints = folder_,
                             .progress = [&](int, double, double) { ++epochs; }};
    EXPECT_TRUE(same(train(data, options, second), whole));
    EXPECT_EQ(epochs, 3);
    // A finished one is not done again, and may be prolonged.
    EXPECT_TRUE(same(train(data, options, second), whole));
    EXPECT_EQ(epochs, 3);
    options.epochs = 7;
    EXPECT_TRUE(same(train(data, options, second), train(data, options, {})));
    EXPECT_EQ(epochs, 4);
  }
}

TEST_F(TrainingFolder, CheckPointsOfAnotherTrainingAreRefused) {
  const DataSet data = test::made_up_data(2, {32});
  TrainingOptions options = small(1);
  train(data, options, {.checkpoints = folder_});
  options.learning_rate = 0.001;
  EXPECT_THROW(train(data, options, {.checkpoints = folder_}), InputError);
  options = small(1);
  EXPECT_THROW(train(test::made_up_data(3, {32}), options, {.checkpoints = folder_}), InputError);
}

TEST_F(TrainingFolder, CheckPointThatIsDamagedIsRefusedWithTheWayOut) {
  const DataSet data = test::made_up_data(2, {32});
  train(data, small(1), {.checkpoints = folder_});
  const fs::path file = folder_ / "training.checkpoint";
  fs::resize_file(file, fs::file_size(file) / 2);
  try {
    train(data, small(1), {.checkpoints = folder_});
    FAIL() << "it was used";
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(file.string()), std::string::npos) << what;
    EXPECT_NE(what.find("remove it to begin anew"), std::string::npos) << what;
  }
}

TEST_F(TrainingFolder, LossThatIsNoNumberStopsItAndKeepsTheLastGoodEpoch) {
  const DataSet data = test::made_up_data(2, {32});
  TrainingOptions options = small(5);
  options.later_from = 3;
  options.later_rate = 1e38;  // the first step with it ruins the weights
  try {
    train(data, options, {.checkpoints = folder_});
    FAIL() << "no failure";
  } catch (const TrainingFailure& failure) {
    const std::string what = failure.what();
    EXPECT_NE(what.find("step 8 (epoch 4"), std::string::npos) << what;
    EXPECT_NE(what.find("epoch 3 is kept"), std::string::npos) << what;
  }
  options.epochs = 3;  // what is kept is good
  EXPECT_EQ(train(data, options, {.checkpoints = folder_}).epochs.size(), 3u);
}

TEST(Training, StopsOnceTheLossIsStable) {
  const DataSet data = test::made_up_data(2, {32});
  TrainingOptions options = small(100);
  options.stable_loss = 0.02;
  const Model model = train(data, options, {});
  EXPECT_LT(model.epochs.size(), 100u);
  EXPECT_LT(model.epochs.back().loss, 0.02);
  EXPECT_GE(model.epochs[model.epochs.size() - 2].loss, 0.02);
}

TEST(Training, IsTheSameInAnyUnitOfTheFields) {
  const DataSet metres = test::made_up_data(3, {32});
  DataSet quarters = metres;  // a power of two: nothing is rounded
  quarters.field_unit = 0.25;
  for (neural::Pattern& pattern : quarters.patterns) {
    for (float& value : pattern.fields[32]) value *= 0.25f;
  }
  const Model a = train(metres, small(2), {}), b = train(quarters, small(2), {});
  EXPECT_TRUE(same(a, b));
  auto small_field = neural::make_decoder(b)->decode({b.row(0), {}}, 32, 1).values;
  for (float& value : small_field) value *= 4;
  EXPECT_EQ(neural::make_decoder(a)->decode({a.row(0), {}}, 32, 1).values, small_field);
  EXPECT_EQ(pattern_losses(a, metres, 1), pattern_losses(b, quarters, 1));
}

TEST(Training, FillsTheCodebookWithPairsOfTheTrainingSet) {
  const DataSet data = test::made_up_data(5, {32});
  TrainingOptions options = small(1);
  EXPECT_EQ(train(data, options, {}).rows(), 5u);
  options.codebook_rows = 3;
  const Model model = train(data, options, {});
  ASSERT_EQ(model.rows(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto pattern = static_cast<std::size_t>(model.codebook_pattern[k]);
    const auto code = neural::encode(model.siren, data.patterns[pattern].impulses);
    EXPECT_TRUE(std::equal(code.begin(), code.end(), model.row(k).begin()));
  }
}

TEST(Training, LeavesNoShapeWithoutRows) {
  DataSet data = test::made_up_data(6, {32});
  data.shapes.push_back(data.shapes.front());
  data.shapes.back().name = "another";
  data.shapes.back().digest = "another";
  data.patterns.back().shape = 1;
  TrainingOptions options = small(1);
  for (const int rows : {1, 2}) {
    options.codebook_rows = rows;
    const Model model = train(data, options, {});
    EXPECT_EQ(std::ranges::count(model.codebook_shape, 0), rows);
    EXPECT_EQ(std::ranges::count(model.codebook_shape, 1), 1) << "it has no more patterns";
  }
}

TEST(Training, RefusesWhatDoesNotFit) {
  const DataSet data = test::made_up_data(2, {32});
  TrainingOptions options = small(1);
  EXPECT_THROW(train(DataSet{}, options, {}), InputError);
  EXPECT_THROW(train(data, options, {.device = "abacus"}), InputError);
  if (!torch::cuda::is_available()) {
    EXPECT_THROW(train(data, options, {.device = "cuda"}), InputError);
  }
  options.network.features = 2;
  EXPECT_THROW(train(data, options, {}), InputError);
  options = small(1);
  options.network.resolutions = {64};
  EXPECT_THROW(train(data, options, {}), InputError);
}

TEST(TrainingOptions, SurviveJson) {
  TrainingOptions options = small(17);
  options.loss = Loss::dice;
  options.segment_codes = SegmentCodes::random;
  options.stable_loss = 0.001;
  options.codebook_rows = 9;
  EXPECT_EQ(to_json(training_options_from_json(to_json(options))), to_json(options));
  auto bad = to_json(options);
  bad["epochs"] = 0;
  EXPECT_THROW(training_options_from_json(bad), InputError);
  bad = to_json(options);
  bad["loss"] = "l7";
  EXPECT_THROW(training_options_from_json(bad), InputError);
}

}  // namespace
}  // namespace fracbench::training
