#include "neural/training_program.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "core/error.h"

namespace fracbench::neural {
namespace {

namespace fs = std::filesystem;

/// A program in the place of fracbench-train.
class TrainingProgram : public ::testing::Test {
 protected:
  explicit TrainingProgram() { ::setenv("FRACBENCH_TRAINER", file_.c_str(), 1); }
  ~TrainingProgram() override {
    ::unsetenv("FRACBENCH_TRAINER");
    fs::remove(file_);
  }
  void says(const std::string& script) const {
    std::ofstream(file_) << "#!/bin/sh\n" << script;
    fs::permissions(file_, fs::perms::owner_all);
  }
  const fs::path file_ = fs::temp_directory_path() / ("trainer-" + std::to_string(::getpid()));
};

TEST_F(TrainingProgram, TellsOfEpochsSecondsAndWhatItHasToSay) {
  says(
      "echo epoch 3 4 0.5 7\necho 'message a check point: damaged'\necho messages\n"
      "echo seconds 2.5\necho noise\n");
  std::string told;
  run_training_program({}, "test",
                       {.on_epoch =
                            [&](double fraction, double loss) {
                              EXPECT_EQ(fraction, 0.75);
                              EXPECT_EQ(loss, 0.5);
                              told += "epoch;";
                            },
                        .on_seconds =
                            [&](double seconds) {
                              EXPECT_EQ(seconds, 2.5);
                              told += "seconds;";
                            },
                        .on_message = [&](std::string_view text) { told += text; }});
  EXPECT_EQ(told, "epoch;a check point: damagedseconds;");
  run_training_program({}, "test", {});  // nobody has to listen
}

TEST_F(TrainingProgram, WhatItRefusesIsBadInputAndElseTheTrainingFailed) {
  says("echo too wide >&2; exit 2\n");
  EXPECT_THROW(run_training_program({}, "test", {}), InputError);
  says("exit 3\n");
  EXPECT_THROW(run_training_program({}, "test", {}), MethodFailure);
}

}  // namespace
}  // namespace fracbench::neural
