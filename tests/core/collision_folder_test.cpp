#include "core/collision_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "core/error.h"
#include "core/temporary_folder.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTwo =
    R"({"impulses": [{"point": [1, 0, 0], "direction": [-2, 0, 0], "magnitude": 5},
                     {"point": [0, 1, 0], "direction": [0, -1, 0], "magnitude": 7}]})";

class CollisionFolder : public testing::Test {
 protected:
  void write(const fs::path& name, const std::string& text) {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }

  std::string error() {
    try {
      read_collision_folder(root_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }

  TemporaryWorkFolder folder_{"test"};
  fs::path root_ = folder_.path();
};

TEST_F(CollisionFolder, GivesImpulsesByStrengthAndFilesByName) {
  write("b/impulses.json", kTwo);
  write("b/2.obj", "");
  write("b/1.obj", "");
  write("a/x.obj", "");
  write("impulses.json", R"({"a": )" + std::string(kTwo) + "}");
  const auto collisions = read_collision_folder(root_);
  ASSERT_EQ(collisions.size(), 2u);
  EXPECT_EQ(collisions[0].name, "a");
  ASSERT_EQ(collisions[1].impulses.size(), 2u);
  EXPECT_EQ(collisions[1].impulses[0].magnitude, 7);
  EXPECT_EQ(collisions[1].impulses[1].direction, Vec3(-1, 0, 0));
  ASSERT_EQ(collisions[1].files().size(), 3u);
  EXPECT_EQ(collisions[1].files()[0].filename(), "1.obj");
}

TEST_F(CollisionFolder, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(error().find("holds no folder"), std::string::npos);
  write("a/1.obj", "");
  EXPECT_NE(error().find("no impulses.json"), std::string::npos);
  const auto error_of = [&](const std::string& text) {
    write("a/impulses.json", text);
    const std::string said = error();
    EXPECT_NE(said.find("impulses.json"), std::string::npos) << said;
    return said;
  };
  error_of("not JSON");
  error_of("[1, 2]");
  EXPECT_NE(error_of(R"({"impulses": []})").find("no impulses"), std::string::npos);
  EXPECT_NE(error_of(R"({"impulses": [7]})").find("impulse 0"), std::string::npos);
  EXPECT_NE(error_of(R"({"impulses": [{"point": [1, 2]}]})").find("'point'"), std::string::npos);
  EXPECT_NE(error_of(R"({"impulses": [{"point": [1, 2, 3], "direction": [1, 0, "x"]}]})")
                .find("'direction'"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"impulses": [{"point": [1, 2, 3], "direction": [1, 0, 0]}]})")
                .find("'magnitude'"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"impulses": [{"point": [1, 2, 3], "direction": [0, 0, 0],
                                       "magnitude": 1}]})")
                .find("'direction'"),
            std::string::npos);
  root_ /= "nothing";
  EXPECT_NE(error().find("is no folder"), std::string::npos);
}

}  // namespace
}  // namespace fracbench
