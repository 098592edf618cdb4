#include "training/representation_study.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace fracbench::training {
namespace {

StudyOptions small() {
  return {.side = 32, .patterns = 3, .least_sites = 4, .most_sites = 4, .epochs = 60};
}

// Exact images give their regions back but for what a border hides; so do learned lines and
// distances, once they are learned by heart.
TEST(RepresentationStudy, LearnsDiagramsByHeartAndReadsTheirRegionsBack) {
  const auto results = study_representations(small());
  ASSERT_EQ(results.size(), 3u);
  for (const StudyResult& result : results) {
    EXPECT_GT(result.ceiling, 0.9) << to_string(result.representation);
    EXPECT_EQ(result.decoded.size(), 3u * 32 * 32);
    if (result.representation != Representation::labels) {
      EXPECT_GT(result.agreement, 0.8) << to_string(result.representation);
    }
  }
}

TEST(RepresentationStudy, IsTheSameForTheSameSeed) {
  StudyOptions options = small();
  options.epochs = 2;
  const auto a = study_representations(options), b = study_representations(options);
  EXPECT_EQ(a[2].decoded, b[2].decoded);
  options.seed = 2;
  EXPECT_NE(study_representations(options)[2].targets, a[2].targets);
}

TEST(RepresentationStudy, StopsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  StudyOptions options = small();
  options.stop = source.get_token();
  EXPECT_THROW(study_representations(options), Cancelled);
}

}  // namespace
}  // namespace fracbench::training
