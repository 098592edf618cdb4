#include "training/representation_study.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"

namespace fracbench::training {
namespace {

using neural::Representation;
using neural::StudyOutcome;
using neural::StudySettings;

StudySettings small() {
  return {.side = 32, .patterns = 3, .least_sites = 4, .most_sites = 4, .epochs = 60};
}

// Exact images give their regions back but for what a border hides; so do learned lines and
// distances, once they are learned by heart.
TEST(RepresentationStudy, LearnsDiagramsByHeartAndReadsTheirRegionsBack) {
  int epochs = 0;
  const neural::RepresentationStudy study = study_representations(
      small(), {.progress = [&](int epoch, double) { EXPECT_EQ(epoch, ++epochs); }});
  EXPECT_EQ(epochs, 3 * 60);
  EXPECT_EQ(study.true_regions, std::vector<double>(3, 4.0));
  ASSERT_EQ(study.outcomes.size(), 3u);
  for (const StudyOutcome& outcome : study.outcomes) {
    EXPECT_EQ(outcome.decoded.size(), 3u * 32 * 32);
    EXPECT_EQ(outcome.loss.size(), 60u);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GT(outcome.ceiling[k], 0.9) << to_string(outcome.representation);
      if (outcome.representation == Representation::labels) continue;
      EXPECT_GT(outcome.agreement[k], 0.6) << to_string(outcome.representation);
    }
    // As many regions in the picture as were counted, called 0, 1, 2, ...
    const auto begin = outcome.back.begin();
    EXPECT_EQ(1 + *std::max_element(begin, begin + 32 * 32), outcome.regions[0]);
  }
}

TEST(RepresentationStudy, IsTheSameForTheSameSeed) {
  StudySettings settings = small();
  settings.epochs = 2;
  const auto a = study_representations(settings), b = study_representations(settings);
  EXPECT_EQ(a, b);
  settings.seed = 2;
  EXPECT_NE(study_representations(settings).outcomes[2].targets, a.outcomes[2].targets);
}

TEST(RepresentationStudy, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(study_representations(small(), {.stop = source.get_token()}), Cancelled);
}

TEST(RepresentationStudy, RefusesSettingsOutOfRange) {
  for (const StudySettings& settings :
       {StudySettings{.side = 48}, StudySettings{.patterns = 0}, StudySettings{.epochs = 0},
        StudySettings{.least_sites = 9, .most_sites = 3}, StudySettings{.learning_rate = -1}}) {
    EXPECT_THROW(study_representations(settings), InputError);
  }
}

}  // namespace
}  // namespace fracbench::training
