#include "training/representation_study.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.h"
#include "training/checkpoint.h"
#include "training/network.h"

namespace fracbench::training {
namespace {

namespace fs = std::filesystem;
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

class StudyFolder : public ::testing::Test {
 protected:
  StudyFolder() {
    std::string name = (fs::temp_directory_path() / "fracbench-study-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    folder_ = name;
  }
  ~StudyFolder() override { fs::remove_all(folder_); }

  static StudySettings tiny() {
    return {.side = 16, .patterns = 2, .least_sites = 3, .most_sites = 4, .epochs = 5};
  }
  /// Stops it after that epoch.
  void stop_after(int last) const {
    std::stop_source source;
    const StudyRun run{
        .checkpoints = folder_, .stop = source.get_token(), .progress = [&](int epoch, double) {
          if (epoch == last) source.request_stop();
        }};
    EXPECT_THROW(study_representations(tiny(), run), Cancelled);
  }
  /// Goes on, and returns the epochs that were learned.
  std::vector<int> finish(const neural::RepresentationStudy& whole) {
    std::vector<int> epochs;
    const StudyRun run{.checkpoints = folder_,
                       .progress = [&](int epoch, double) { epochs.push_back(epoch); },
                       .message = [&](std::string_view text) { said_ += text; }};
    EXPECT_EQ(study_representations(tiny(), run), whole);
    return epochs;
  }
  fs::path checkpoint(Representation of) const { return folder_ / to_string(of); }

  fs::path folder_;
  std::string said_;
};

TEST_F(StudyFolder, GoesOnAfterItsLastCheckPointAsIfNothingHadHappened) {
  const neural::RepresentationStudy whole = study_representations(tiny());
  // The first check point of each training is that of its first epoch, the last that of its last.
  for (const int last : {1, 5, 6, 10, 11, 15}) {
    fs::remove_all(folder_);
    stop_after(last);
    const std::vector<int> left = study_epochs_left(tiny(), {.checkpoints = folder_});
    EXPECT_EQ(left[0] + left[1] + left[2], 15 - last);
    const std::vector<int> epochs = finish(whole);
    ASSERT_EQ(static_cast<int>(epochs.size()), 15 - last);
    EXPECT_TRUE(epochs.empty() || epochs.front() == last + 1) << epochs.front();
  }
  EXPECT_TRUE(finish(whole).empty());
  EXPECT_EQ(said_, "");
}

TEST_F(StudyFolder, CheckPointThatCannotBeUsedIsMadeAnewAndToldOf) {
  const neural::RepresentationStudy whole = study_representations(tiny());
  study_representations(tiny(), {.checkpoints = folder_});
  const auto made_anew = [&](const std::string& why) {
    said_.clear();
    EXPECT_EQ(finish(whole), (std::vector<int>{6, 7, 8, 9, 10})) << why;
    EXPECT_NE(said_.find(why), std::string::npos) << said_;
    EXPECT_NE(said_.find("lines begin anew"), std::string::npos) << said_;
    EXPECT_EQ(said_.find("labels begin"), std::string::npos) << said_;
  };
  const fs::path lines = checkpoint(Representation::lines);
  fs::resize_file(checkpoint_file(lines), fs::file_size(checkpoint_file(lines)) / 2);
  made_anew("damaged");
  const Checkpoint kept = *read_checkpoint(lines);
  TensorMap tensors;
  for (const auto& [name, values] : kept.arrays) {
    tensors[name] = tensor_of(values, {static_cast<std::int64_t>(values.size())});
  }
  ASSERT_EQ(tensors.erase("first/codes"), 1u);
  write_checkpoint(lines, kept.state, tensors);
  made_anew("no fitting 'first/codes'");
  fs::copy_file(checkpoint_file(checkpoint(Representation::labels)), checkpoint_file(lines),
                fs::copy_options::overwrite_existing);
  made_anew("of other settings");
}

TEST_F(StudyFolder, CheckPointsAreOfAllThatDeterminesTheOutcome) {
  study_representations(tiny(), {.checkpoints = folder_});
  const auto all_again = [&](const StudySettings& settings, int threads = 1) {
    return study_epochs_left(settings, {.threads = threads, .checkpoints = folder_}) ==
           std::vector<int>(3, settings.epochs);
  };
  EXPECT_FALSE(all_again(tiny()));
  EXPECT_TRUE(all_again(tiny(), 2));
  const auto with = [&](auto change) {
    StudySettings settings = tiny();
    change(settings);
    return settings;
  };
  EXPECT_TRUE(all_again(with([](auto& s) { s.seed = 2; })));
  EXPECT_TRUE(all_again(with([](auto& s) { s.epochs = 6; })));
  EXPECT_TRUE(all_again(with([](auto& s) { s.patterns = 3; })));
  EXPECT_TRUE(all_again(with([](auto& s) { s.most_sites = 5; })));
  EXPECT_TRUE(all_again(with([](auto& s) { s.learning_rate = 0.002; })));
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
