#include "methods/deepfracture/deepfracture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "geometry/measures.h"
#include "tests/methods/learned_boxes.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using learned_boxes::impact_at;
using learned_boxes::same_pieces;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;

// The smallest network that there is, hardly trained: what is tested here does not depend on what
// it has learned.
class DeepFractureTest : public testing::Test {
 protected:
  Options options(OptionMap given = {}) const {
    OptionMap all{
        {"resolutions", std::vector<double>{32}}, {"width", 1.0 / 64}, {"epochs", std::int64_t{3}}};
    for (const auto& [name, value] : given) all[name] = value;
    return Options(method.options(), all, "test");
  }
  std::unique_ptr<Breakable> prepared(const Options& with, std::uint64_t seed = 11) const {
    learned_boxes::QuietContext context(seed);
    return method.prepare(target, data, with, context.get());
  }
  static std::vector<Piece> broken(const Breakable& breakable, double x, std::uint64_t seed = 5) {
    learned_boxes::QuietContext context(seed);
    return breakable.fracture(impact_at(x), context.get());
  }

  DeepFractureMethod method;
  Target target = learned_boxes::body();
  LearningData data = learned_boxes::learning_data(4);
};

TEST_F(DeepFractureTest, ThePiecesFillTheBody) {
  const auto breakable = prepared(options());
  for (const double x : {-0.5, 0.3}) {
    double sum = 0;
    for (const Piece& piece : broken(*breakable, x)) {
      sum += volume(piece.mesh);
      EXPECT_EQ(piece.faces.size(), piece.mesh.faces.size());
      EXPECT_EQ(piece.next, nullptr);
    }
    EXPECT_NEAR(sum, volume(target.mesh), 1e-12);
  }
}

TEST_F(DeepFractureTest, TheSameSeedGivesTheSameModelAndTheSamePieces) {
  const auto one = prepared(options());
  const auto two = prepared(options());
  EXPECT_TRUE(same_pieces(broken(*one, 0.2), broken(*two, 0.2)));
}

TEST_F(DeepFractureTest, SavedAndLoadedItAnswersTheSame) {
  const auto breakable = prepared(options());
  const fs::path folder = learned_boxes::fresh_folder("deepfracture");
  breakable->save(folder);
  const auto loaded = method.load(folder, target, options());
  EXPECT_TRUE(same_pieces(broken(*breakable, 0.2), broken(*loaded, 0.2)));

  // The model's file alone does as well.
  const std::string file = (folder / "model.fracbench").string();
  data.examples.clear();
  const auto elsewhere = prepared(options({{"model", file}}));
  EXPECT_TRUE(same_pieces(broken(*breakable, 0.2), broken(*elsewhere, 0.2)));
  EXPECT_THROW(prepared(options({{"model", file}, {"resolutions", std::vector<double>{64}}})),
               InputError);
  target.mesh.vertices[0].x() += 0.01;
  EXPECT_THROW(prepared(options({{"model", file}})), InputError);
  EXPECT_THROW(method.load(folder, target, options()), InputError);
  target = learned_boxes::body();
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_THROW(method.load(folder, target, options()), InputError);
  fs::remove_all(folder);
}

TEST_F(DeepFractureTest, OneModelLearnsSeveralShapesAndIsTheSameForEachOfThem) {
  // The same box and its fractures, half as high.
  const auto flattened = [](TriangleMesh mesh) {
    for (Vec3& v : mesh.vertices) v.z() /= 2;
    return mesh;
  };
  Target flat{.name = "flat", .mesh = flattened(target.mesh), .material = {}};
  LearningData of_flat = learned_boxes::learning_data(3);
  for (LearningExample& example : of_flat.examples) {
    for (Fragment& fragment : example.fragments) fragment.mesh = flattened(fragment.mesh);
  }
  LearningData for_box = data, for_flat = of_flat;
  for_box.further = {{.shape = flat.name,
                      .mesh = flat.mesh,
                      .examples = of_flat.examples,
                      .max_impulse = of_flat.max_impulse}};
  for_flat.further = {{.shape = target.name,
                       .mesh = target.mesh,
                       .examples = data.examples,
                       .max_impulse = data.max_impulse}};
  const Options with = options();
  learned_boxes::QuietContext first, second;
  const auto box_body = method.prepare(target, for_box, with, first.get());
  const auto flat_body = method.prepare(flat, for_flat, with, second.get());
  const fs::path folder = learned_boxes::fresh_folder("deepfracture-both");
  flat_body->save(folder);
  EXPECT_TRUE(same_pieces(broken(*box_body, 0.2), broken(*method.load(folder, target, with), 0.2)));

  // Each answers with a row of its own patterns, and says so.
  const auto found = [](const Breakable& body, std::string_view name) {
    learned_boxes::QuietContext context(5);
    std::vector<Finding> findings;
    context.get().findings = &findings;
    body.fracture(impact_at(0.2), context.get());
    const auto at = std::ranges::find(findings, name, &Finding::name);
    return at == findings.end() ? std::vector<double>() : at->values;
  };
  EXPECT_EQ(found(*box_body, "deepfracture_shapes"), std::vector<double>{2});
  EXPECT_EQ(found(*box_body, "deepfracture_round_trip").size(), data.examples.size());
  EXPECT_EQ(found(*flat_body, "deepfracture_round_trip").size(), of_flat.examples.size());
  EXPECT_EQ(found(*method.load(folder, target, with), "deepfracture_round_trip"),
            found(*box_body, "deepfracture_round_trip"));

  EXPECT_THROW(method.prepare(target, for_box, options({{"quantise", false}}), first.get()),
               InputError);
  EXPECT_THROW(
      method.prepare(target, for_box, options({{"decoder", std::string("pix2pix")}}), first.get()),
      InputError);
  fs::remove_all(folder);
}

TEST_F(DeepFractureTest, EveryPredictionTellsTheCeilingAndWhatRandomCodesChange) {
  const auto breakable = prepared(options());
  learned_boxes::QuietContext context(5);
  breakable->fracture(impact_at(0.2), context.get());
  EXPECT_THAT(context.notes, Contains(HasSubstr("the ceiling")));
  EXPECT_THAT(context.notes, Contains(HasSubstr("of the codebook")));
  EXPECT_THAT(context.notes, Contains(HasSubstr("random codes choose another row")));
}

TEST_F(DeepFractureTest, EveryVariantCanBeTrained) {
  const std::vector<OptionMap> variants{
      {{"quantise", false}, {"truncation", 0.1}},
      {{"segment_codes", std::string("random")}, {"fracture_surfaces", std::string("as-surface")}},
      {{"segment_code", std::int64_t{0}}, {"loss", std::string("dice")}},
      {{"normalisation", std::string("group")}, {"loss", std::string("eikonal")}},
      {{"statistics", std::string("running")}, {"parity", true}},
      {{"statistics", std::string("reestimated")}, {"features", std::int64_t{2}}}};
  for (const OptionMap& given : variants) {
    SCOPED_TRACE(given.begin()->first);
    const auto breakable = prepared(options(given));
    try {
      EXPECT_FALSE(broken(*breakable, 0.1).empty());
    } catch (const MethodFailure& failure) {  // so little training may leave nothing inside
      EXPECT_THAT(failure.what(),
                  AnyOf(HasSubstr("cannot be segmented"), HasSubstr("none is left")));
    }
  }
}

TEST_F(DeepFractureTest, WhatCannotBeLearnedFromIsRefusedWithTheWayOut) {
  data.examples.resize(1);
  try {
    prepared(options());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("[learning]"));
  }
  data = learned_boxes::learning_data(3);
  data.max_impulse = 0;
  EXPECT_THROW(prepared(options()), InputError);
}

}  // namespace
}  // namespace fracbench
