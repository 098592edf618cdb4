#include "methods/nearest-pattern/nearest_pattern.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "core/random.h"
#include "tests/methods/learned_boxes.h"

namespace fracbench {
namespace {

using learned_boxes::body;
using learned_boxes::example;
using learned_boxes::impact_at;
using learned_boxes::same_pieces;

class NearestPatternTest : public testing::Test {
 protected:
  NearestPatternTest() {
    for (const double x : {-0.6, -0.2, 0.1, 0.5}) data.examples.push_back(example(x));
    data.max_impulse = 3e5;
  }
  std::unique_ptr<Breakable> prepared() {
    return method.prepare(target, data, options, context.get());
  }

  NearestPatternMethod method;
  Options options{method.options(), {}, "test"};
  Target target = body();
  LearningData data;
  learned_boxes::QuietContext context;
};

TEST_F(NearestPatternTest, ReturnsTheFragmentsOfALearnedImpactForThatImpact) {
  const auto breakable = prepared();
  for (const LearningExample& learned : data.examples) {
    const std::vector<Piece> pieces = breakable->fracture(learned.impact, context.get());
    ASSERT_EQ(pieces.size(), learned.fragments.size());
    for (std::size_t n = 0; n < pieces.size(); ++n) {
      EXPECT_EQ(pieces[n].mesh.vertices, learned.fragments[n].mesh.vertices);
      EXPECT_EQ(pieces[n].mesh.faces, learned.fragments[n].mesh.faces);
      for (std::size_t f = 0; f < pieces[n].faces.size(); ++f) {
        EXPECT_EQ(pieces[n].faces[f].parent_face, learned.fragments[n].faces[f].original_face);
        EXPECT_EQ(pieces[n].faces[f].neighbour,
                  pieces[n].faces[f].is_fracture() ? 1 - static_cast<int>(n) : -1);
      }
    }
  }
}

TEST_F(NearestPatternTest, TakesTheExampleWithTheNearestImpulse) {
  const auto breakable = prepared();
  EXPECT_TRUE(same_pieces(breakable->fracture(impact_at(0.2), context.get()),
                          breakable->fracture(data.examples[2].impact, context.get())));
  EXPECT_TRUE(same_pieces(breakable->fracture(impact_at(0.9), context.get()),
                          breakable->fracture(data.examples[3].impact, context.get())));
}

TEST_F(NearestPatternTest, SavedAndLoadedItAnswersTheSame) {
  const auto breakable = prepared();
  const auto folder = learned_boxes::fresh_folder("nearest_pattern");
  breakable->save(folder);
  const auto loaded = method.load(folder, target, options);
  for (const double x : {-0.5, 0.0, 0.4}) {
    EXPECT_TRUE(same_pieces(breakable->fracture(impact_at(x), context.get()),
                            loaded->fracture(impact_at(x), context.get())));
  }
  Target other = target;
  other.mesh.vertices[0].x() += 0.01;
  EXPECT_THROW(method.load(folder, other, options), InputError);
  const auto file = folder / "patterns.fracbench";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW(method.load(folder, target, options), InputError);
  std::filesystem::remove_all(folder);
}

TEST_F(NearestPatternTest, NothingToLearnFromIsRefused) {
  data.examples.clear();
  EXPECT_THROW(prepared(), InputError);
}

}  // namespace
}  // namespace fracbench
