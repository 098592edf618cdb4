#include "neural/model.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <set>

#include "core/array_file.h"
#include "core/error.h"
#include "made_up_data.h"
#include "neural/data_set.h"
#include "neural/voxel_decoder.h"

namespace fracbench::neural {
namespace {

namespace fs = std::filesystem;

class NeuralFiles : public ::testing::Test {
 protected:
  ~NeuralFiles() override { fs::remove(file_); }
  const fs::path file_ = fs::temp_directory_path() / ("neural-" + std::to_string(::getpid()));
};

/// A model with random weights, and the codes of its patterns in the codebook.
Model random_model(NetworkOptions network, const DataSet& data) {
  Random random(3);
  Model model{.network = network,
              .shapes = data.shapes,
              .field_unit = 0.5,
              .siren = make_siren(network, random),
              .weights = {},
              .statistics = {},
              .codebook = {},
              .codebook_pattern = {},
              .codebook_shape = {},
              .epochs = {{0.5, 1}, {0.25, 1}},
              .provenance = "{}"};
  for (const WeightSpec& spec : weight_specs(network)) {
    for (std::size_t k = 0; k < spec.size(); ++k) {
      model.weights[spec.name].push_back(static_cast<float>(0.05 * random.normal()));
    }
  }
  for (std::size_t k = 0; k < data.patterns.size(); ++k) {
    std::vector<float> row = encode(model.siren, data.patterns[k].impulses);
    const auto segment = random_segment_code(network.segment_code, random);
    row.insert(row.end(), segment.begin(), segment.end());
    model.codebook.insert(model.codebook.end(), row.begin(), row.end());
    model.codebook_pattern.push_back(static_cast<std::int32_t>(k));
    model.codebook_shape.push_back(data.patterns[k].shape);
  }
  return model;
}

TEST_F(NeuralFiles, DataSetComesBackAsItWas) {
  const DataSet data = test::made_up_data(3, {16, 32}, 2);
  write_data_set(file_, data);
  EXPECT_EQ(read_data_set(file_), data);
  EXPECT_LT(fs::file_size(file_), 3 * 4 * (16 * 16 * 16 + 32 * 32 * 32));
}

TEST_F(NeuralFiles, DataSetsWhoseNumbersDoNotFitAreRefused) {
  const DataSet good = test::made_up_data(2, {16});
  const auto refused = [&](const DataSet& data) {
    write_data_set(file_, data);
    EXPECT_THROW(read_data_set(file_), InputError);
  };
  DataSet bad = good;
  bad.patterns[1].fields[16].pop_back();
  refused(bad);
  bad = good;
  bad.patterns[1].fields[32] = test::made_up_data(1, {32}).patterns[0].fields[32];
  refused(bad);
  bad = good;
  bad.patterns[0].impulses.push_back(0);
  refused(bad);
  bad = good;
  bad.patterns[0].fields[16][7] = NAN;
  refused(bad);
  bad = good;
  bad.shapes[0].scaling.max_impulse = 0;
  refused(bad);
  bad = good;
  bad.patterns[1].shape = 1;
  refused(bad);
  bad = good;
  bad.shapes.clear();
  refused(bad);
  bad = good;
  bad.field_unit = 0;
  refused(bad);
}

TEST_F(NeuralFiles, DataSetsOfSeveralShapesAreJoinedIntoOne) {
  const DataSet ball = test::made_up_data(2, {16});
  DataSet box = test::made_up_data(3, {16});
  box.shapes[0] = {.name = "box", .digest = "4567", .scaling = {.half_side = 0.5}};
  const DataSet both = joined({ball, box});
  EXPECT_EQ(names_of(both.shapes), "ball, box");
  ASSERT_EQ(both.patterns.size(), 5u);
  EXPECT_EQ(both.patterns[1], ball.patterns[1]);
  EXPECT_EQ(both.patterns[2].shape, 1);
  EXPECT_EQ(both.patterns[2].fields, box.patterns[0].fields);
  write_data_set(file_, both);
  EXPECT_EQ(read_data_set(file_), both);
  EXPECT_EQ(find_shape(both.shapes, "4567"), 1u);
  EXPECT_EQ(find_shape(both.shapes, "89"), std::nullopt);
  EXPECT_EQ(joined({ball}), ball);

  EXPECT_THROW(joined({}), InputError);
  EXPECT_THROW(joined({ball, ball}), InputError);
  DataSet other = box;
  other.field_unit = 0.1;
  EXPECT_THROW(joined({ball, other}), InputError);
  other = test::made_up_data(3, {32});
  other.shapes = box.shapes;
  EXPECT_THROW(joined({ball, other}), InputError);
}

TEST_F(NeuralFiles, ModelComesBackAsItWas) {
  const DataSet data = test::made_up_data(3, {32});
  for (const Statistics statistics : {Statistics::sample, Statistics::reestimated}) {
    Model model =
        random_model({.resolutions = {32}, .width = 1.0 / 32, .statistics = statistics}, data);
    if (statistics != Statistics::sample) {
      const auto out = static_cast<std::size_t>(decoder_blocks(model.network)[0].out);
      model.statistics["block0.mean"].assign(out, 0.1f);
      model.statistics["block0.variance"].assign(out, 2.0f);
    }
    write_model(file_, model);
    const Model again = read_model(file_);
    EXPECT_EQ(again.network, model.network);
    EXPECT_EQ(again.shapes, model.shapes);
    EXPECT_EQ(again.field_unit, model.field_unit);
    EXPECT_EQ(again.siren, model.siren);
    EXPECT_EQ(again.weights, model.weights);
    EXPECT_EQ(again.statistics, model.statistics);
    EXPECT_EQ(again.codebook, model.codebook);
    EXPECT_EQ(again.epochs.size(), 2u);
    const VoxelDecoder before(model), after(again);
    EXPECT_EQ(before.decode({model.row(1), {}}, 32, 1).values,
              after.decode({again.row(1), {}}, 32, 1).values);
  }
}

// The check sum fits, the arrays do not.
TEST_F(NeuralFiles, ModelsWithArraysOfAnotherSizeAreRefused) {
  constexpr ArrayFileKind kind{.format = "fracbench model", .version = 2};
  const Model model =
      random_model({.resolutions = {32}, .width = 1.0 / 32}, test::made_up_data(2, {16}));
  write_model(file_, model);
  const ArrayFile good = read_array_file(file_, kind);
  const auto complaint = [&](const ArrayFile& bad) -> std::string {
    write_array_file(file_, bad, kind);
    try {
      read_model(file_);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(complaint(good), "");
  for (const auto& [name, values] : good.floats) {
    ArrayFile bad = good;
    bad.floats[name].pop_back();
    EXPECT_NE(complaint(bad).find(name), std::string::npos) << name;
    bad = good;
    bad.floats[name][0] = INFINITY;
    EXPECT_NE(complaint(bad).find(name), std::string::npos) << name;
  }
  ArrayFile bad = good;
  bad.texts["network"] = R"({"resolutions":[32]})";
  EXPECT_NE(complaint(bad), "");
  bad.texts["network"] = "no JSON";
  EXPECT_NE(complaint(bad), "");
}

TEST(Codebook, GivesTheRowNearestToTheImpulseAndTheRandomCode) {
  // Impulses far apart: blows at the six ends of the axes.
  DataSet data = test::made_up_data(20, {16});
  for (std::size_t k = 0; k < data.patterns.size(); ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float end = c != k / 2 % 3 ? 0.0f : k % 2 == 0 ? 1.0f : -1.0f;
      data.patterns[k].impulses[c] = end;
      data.patterns[k].impulses[3 + c] = -end;
    }
  }
  const Model model = random_model({.resolutions = {32}, .width = 1.0 / 64}, data);
  Random random(1);
  for (std::size_t k = 0; k < data.patterns.size(); ++k) {
    EXPECT_EQ(nearest_row(model, 0, data.patterns[k].impulses, random) % 6, k % 6);
  }
  // One impulse for all: only the random code chooses, and chooses different rows.
  DataSet same = data;
  for (Pattern& pattern : same.patterns) pattern.impulses = data.patterns[0].impulses;
  const Model alike = random_model(model.network, same);
  std::set<std::size_t> rows;
  for (int k = 0; k < 100; ++k)
    rows.insert(nearest_row(alike, 0, data.patterns[0].impulses, random));
  EXPECT_GT(rows.size(), 5u);
}

TEST(Codebook, AnswersWithARowOfTheShapeThatIsAsked) {
  DataSet other = test::made_up_data(6, {16});
  other.shapes[0] = {.name = "box", .digest = "4567", .scaling = other.shapes[0].scaling};
  const DataSet both = joined({test::made_up_data(4, {16}), std::move(other)});
  const Model model = random_model({.resolutions = {32}, .width = 1.0 / 64}, both);
  Random random(1);
  for (std::size_t k = 0; k < 4; ++k) {
    // The first patterns of both are the same blows.
    const std::vector<float>& blow = both.patterns[k].impulses;
    EXPECT_LT(nearest_row(model, 0, blow, random), 4u);
    EXPECT_GE(nearest_row(model, 1, blow, random), 4u);
  }
  EXPECT_THROW(nearest_row(model, 2, both.patterns[0].impulses, random), InputError);
}

TEST(Codebook, ThatIsEmptyIsAnError) {
  const DataSet data = test::made_up_data(1, {16});
  Model model = random_model({.resolutions = {32}, .width = 1.0 / 64}, data);
  Random random(1);
  EXPECT_THROW(nearest_row(model, 0, std::vector<float>(14), random), InputError);
  model.codebook.clear();
  model.codebook_pattern.clear();
  model.codebook_shape.clear();
  EXPECT_THROW(nearest_row(model, 0, data.patterns[0].impulses, random), InputError);
}

TEST(VoxelDecoder, HasOnlyTheResolutionsOfItsNetwork) {
  const Model model =
      random_model({.resolutions = {32}, .width = 1.0 / 64}, test::made_up_data(1, {16}));
  EXPECT_THROW(VoxelDecoder(model).decode({model.row(0), {}}, 64, 1), InputError);
  EXPECT_THROW(VoxelDecoder(model).decode({model.row(0).first(10), {}}, 32, 1), InputError);
}

}  // namespace
}  // namespace fracbench::neural
