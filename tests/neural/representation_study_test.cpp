#include "neural/representation_study.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/array_file.h"
#include "core/error.h"

namespace fracbench::neural {
namespace {

namespace fs = std::filesystem;

class StudyFile : public ::testing::Test {
 protected:
  ~StudyFile() override { fs::remove(file_); }
  const fs::path file_ = fs::temp_directory_path() / ("study-" + std::to_string(::getpid()));
};

RepresentationStudy made_up_study() {
  RepresentationStudy study{.settings = {.side = 8, .patterns = 2, .epochs = 3, .seed = 9},
                            .true_regions = {6, 7},
                            .outcomes = {}};
  for (const Representation representation : kRepresentations) {
    study.outcomes.push_back({.representation = representation,
                              .loss = {0.5, 0.25, 0.125},
                              .agreement = {0.75, 1},
                              .ceiling = {1, 1},
                              .regions = {6, 8},
                              .targets = std::vector<float>(128, 0.25f),
                              .decoded = std::vector<float>(128, 0.5f),
                              .back = std::vector<std::int32_t>(128, 3)});
  }
  return study;
}

TEST_F(StudyFile, ComesBackAsItWas) {
  write_representation_study(file_, made_up_study());
  EXPECT_EQ(read_representation_study(file_), made_up_study());
}

TEST_F(StudyFile, WithNumbersThatDoNotFitIsRefusedByTheirName) {
  const auto message = [&](auto change) {
    RepresentationStudy study = made_up_study();
    change(study);
    write_representation_study(file_, study);
    try {
      read_representation_study(file_);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message([](auto& s) { s.outcomes[1].decoded.pop_back(); }).find("lines/decoded"),
            std::string::npos);
  EXPECT_NE(message([](auto& s) { s.outcomes[2].loss[1] = NAN; }).find("distance/loss"),
            std::string::npos);
  EXPECT_NE(message([](auto& s) { s.outcomes[0].back[5] = -1; }).find("labels/back"),
            std::string::npos);
  EXPECT_NE(message([](auto& s) { s.settings.side = 1 << 20; }).find("settings"),
            std::string::npos);
  EXPECT_EQ(message([](auto&) {}), "");
}

TEST_F(StudyFile, CutShortIsRefused) {
  write_representation_study(file_, made_up_study());
  fs::resize_file(file_, fs::file_size(file_) / 2);
  EXPECT_THROW(read_representation_study(file_), InputError);
  EXPECT_THROW(read_representation_study(file_ / "missing"), InputError);
}

TEST_F(StudyFile, CheckPointsAreRemovedAndNothingElse) {
  const fs::path folder = study_checkpoints(file_);
  EXPECT_EQ(folder.parent_path(), file_.parent_path());
  const auto make = [&](const fs::path& name) {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << "text";
  };
  make("lines/training.checkpoint");
  make("lines/.fracbench-1-0.part");
  make("notes");
  remove_study_checkpoints(file_);
  EXPECT_FALSE(fs::exists(folder / "lines"));
  EXPECT_TRUE(fs::exists(folder / "notes"));
  fs::remove(folder / "notes");
  remove_study_checkpoints(file_);
  EXPECT_FALSE(fs::exists(folder));
  remove_study_checkpoints(file_);  // where there are none
}

}  // namespace
}  // namespace fracbench::neural
