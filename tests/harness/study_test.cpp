#include "harness/study.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/catalog.h"
#include "harness/suite_reader.h"
#include "temporary_folder.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

/// A suite with a study, and a program in the place of the one that trains.
class StudyOfSuite : public ::testing::Test {
 protected:
  StudyOfSuite() { ::setenv("FRACBENCH_TRAINER", program().c_str(), 1); }
  ~StudyOfSuite() override { ::unsetenv("FRACBENCH_TRAINER"); }

  fs::path program() const { return folder_.path() / "trainer"; }
  fs::path results() const { return folder_.path() / "results"; }
  fs::path file() const { return results() / "study.data"; }
  fs::path check_point() const { return results() / "study.data.checkpoints" / "lines" / "file"; }
  void program_is(const std::string& script) const {
    std::ofstream(program()) << "#!/bin/sh\n" << script;
    fs::permissions(program(), fs::perms::owner_all);
  }
  /// What the study of the suite would be.
  void put_study() const {
    neural::RepresentationStudy study{
        .settings = study_settings(suite_), .true_regions = {3, 3}, .outcomes = {}};
    for (const neural::Representation r : neural::kRepresentations) {
      study.outcomes.push_back({.representation = r,
                                .loss = {0.5},
                                .agreement = {1, 1},
                                .ceiling = {1, 1},
                                .regions = {3, 3},
                                .targets = std::vector<float>(128),
                                .decoded = std::vector<float>(128),
                                .back = std::vector<std::int32_t>(128)});
    }
    fs::create_directories(results());
    neural::write_representation_study(file(), study);
  }

  const TemporaryFolder folder_;
  const Suite suite_ =
      parse_suite("[study]\nside = 8\npatterns = 2\nleast_sites = 3\nmost_sites = 4\nepochs = 1\n",
                  "study.toml", built_in_catalog());
};

TEST_F(StudyOfSuite, CostsWhatTheTrainingProgramMeasuresForWhatIsMissing) {
  program_is("echo \"$@\" >'" + (folder_.path() / "asked").string() + "'\necho seconds 61.5\n");
  const StudyCost cost = study_cost(suite_, results(), {});
  EXPECT_EQ(cost.describe(), "study: 3 representations x 1 epochs x 2 patterns, about 1 min 2 s");
  EXPECT_EQ(cost.as_json()["seconds"], 61.5);
  EXPECT_EQ(cost.as_json()["found"], false);
  EXPECT_FALSE(fs::exists(results()));
  std::ifstream stream(folder_.path() / "asked");
  const std::string asked{std::istreambuf_iterator<char>(stream), {}};
  for (const char* part : {"study-2d", "--time", "--side 8", "--epochs 1", "study.data"}) {
    EXPECT_NE(asked.find(part), std::string::npos) << asked;
  }
}

TEST_F(StudyOfSuite, CostsNothingWhereItIsThere) {
  program_is("exit 3\n");
  put_study();
  const StudyCost cost = study_cost(suite_, results(), {});
  EXPECT_EQ(cost.describe(), "study: 3 representations x 1 epochs x 2 patterns, done");
  EXPECT_EQ(cost.as_json()["found"], true);
}

TEST_F(StudyOfSuite, ThatIsThereNeedsNoCheckPoints) {
  program_is("exit 3\n");
  put_study();
  fs::create_directories(check_point());
  EXPECT_FALSE(make_study(suite_, {.folder = results()}));
  EXPECT_FALSE(fs::exists(results() / "study.data.checkpoints"));
}

TEST_F(StudyOfSuite, PassesOnWhatTheTrainingProgramHasToSay) {
  program_is("echo message a check point: damaged\n");
  fs::create_directories(check_point());
  std::string said;
  EXPECT_TRUE(make_study(
      suite_, {.folder = results(), .message = [&](std::string_view text) { said += text; }}));
  EXPECT_EQ(said, "a check point: damaged");
  EXPECT_TRUE(fs::exists(check_point())) << "they are the training program's to remove";
}

}  // namespace
}  // namespace fracbench
