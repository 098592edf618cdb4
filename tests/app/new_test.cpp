#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "source_folder.h"
#include "tests/app/program.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// What of a clone the command looks at.
class NewMethod : public testing::Test {
 protected:
  NewMethod() {
    fs::create_directories(folder_.path() / "methods");
    fs::copy(FRACBENCH_SOURCE_DIR "/methods/template", folder_.path() / "methods" / "template");
    folder_.write("methods/registry.cpp", "");
  }
  TemporaryFolder folder_;
};

TEST_F(NewMethod, IsWrittenWithNothingLeftToFillIn) {
  const Answer answer = call("new method slab-cutter", folder_.path());
  EXPECT_EQ(answer.exit_code, 0) << answer.errors;
  EXPECT_THAT(answer.output, HasSubstr("#include \"methods/slab-cutter/slab_cutter.h\""));
  EXPECT_THAT(answer.output, HasSubstr("SlabCutterMethod"));
  for (const char* file :
       {"methods/slab-cutter/slab_cutter.h", "methods/slab-cutter/slab_cutter.cpp",
        "tests/methods/slab-cutter/slab_cutter_test.cpp", "docs/methods/slab-cutter.md"}) {
    EXPECT_THAT(folder_.read(file), Not(HasSubstr("@"))) << file;
  }
  EXPECT_THAT(folder_.read("methods/slab-cutter/slab_cutter.cpp"),
              HasSubstr("MethodInfo SlabCutterMethod::info()"));
}

TEST_F(NewMethod, OverwritesNothing) {
  EXPECT_EQ(call("new method mine", folder_.path()).exit_code, 0);
  const Answer again = call("new method mine", folder_.path());
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.errors, HasSubstr("is there already"));
}

TEST_F(NewMethod, RefusesNamesThatWillNotDo) {
  for (const char* name : {"Mine", "../mine", "1st", "cvd", "a_b"}) {
    EXPECT_EQ(call("new method " + std::string(name), folder_.path()).exit_code, 2) << name;
  }
  TemporaryFolder elsewhere;
  EXPECT_THAT(call("new method mine", elsewhere.path()).errors, HasSubstr("no clone"));
}

}  // namespace
}  // namespace fracbench
