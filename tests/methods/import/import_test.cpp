#include "methods/import/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/error.h"
#include "core/temporary_folder.h"
#include "geometry/measures.h"
#include "geometry/write_mesh.h"
#include "scenarios/families.h"
#include "scenarios/scene.h"
#include "scenarios/shapes.h"
#include "tests/methods/cvd/check_pieces.h"

namespace fracbench::test {
namespace {

namespace fs = std::filesystem;

/// The part of the cube with low < x < high.
TriangleMesh slab(double low, double high) {
  TriangleMesh mesh = load_shape({.name = "cube"}).mesh;
  const BoundingBox box = bounding_box(mesh);
  for (Vec3& v : mesh.vertices) {
    const double share = (v.x() - box.low.x()) / (box.high.x() - box.low.x());
    v.x() = low + share * (high - low);
  }
  return mesh;
}

class Import : public testing::Test {
 protected:
  void SetUp() override {
    write_mesh(add("cut") / "left.obj", slab(box_.low.x(), 0.1));
    write_mesh(add("cut") / "right.obj", slab(0.1, box_.high.x()));
  }

  /// The folder of a collision, hit from above by as many kN s as there are collisions with it.
  fs::path add(const std::string& name) {
    const fs::path folder = root_ / name;
    if (fs::create_directories(folder)) {
      ++collisions_;
      std::ofstream(folder / "impulses.json")
          << R"({"impulses": [{"point": [0, 0, )" << box_.high.z()
          << R"(], "direction": [0, 0, -1], "magnitude": )" << 1000 * collisions_ << "}]}";
    }
    return folder;
  }

  SceneResult run(const std::string& name) {
    const ScenarioFamily& family = find_family("imported");
    const auto scenes =
        family.scenes(Options(family.options(), {{"path", root_.string()}}, "test"), "cube", 1);
    const auto scene = std::ranges::find(scenes, name, &Scenario::name);
    if (scene == scenes.end()) throw std::logic_error(name);
    EXPECT_EQ(to_json(scenario_from_json(to_json(*scene))), to_json(*scene));
    Random random(1);
    StageTimer timer;
    Progress progress;
    Context context{.random = random, .timer = timer, .progress = progress};
    const Target target{.name = "cube", .mesh = mesh_, .material = scene->material};
    const Options options(method_.options(), {{"path", root_.string()}}, "test");
    return run_scene(*scene, target, method_.prepare(target, {}, options, context), context);
  }

  std::string failure(const std::string& name) {
    try {
      run(name);
    } catch (const MethodFailure& failure) {
      return failure.what();
    }
    return "none";
  }

  ImportMethod method_;
  TriangleMesh mesh_ = load_shape({.name = "cube"}).mesh;
  BoundingBox box_ = bounding_box(mesh_);
  TemporaryWorkFolder folder_{"test"};
  fs::path root_ = folder_.path();
  int collisions_ = 0;
};

TEST_F(Import, BreaksTheBodyByTheImpulsesThatAreThere) {
  const SceneResult result = run("cut");
  ASSERT_EQ(result.fragments.size(), 2u);
  EXPECT_NEAR(volume(result.fragments[0].mesh) + volume(result.fragments[1].mesh), volume(mesh_),
              1e-12);
  EXPECT_LT(bounding_box(result.fragments[0].mesh).high.x(), 0.1001) << "pieces stay in place";
  ASSERT_EQ(result.impacts.size(), 1u);
  EXPECT_EQ(result.impacts[0].impulses[0].magnitude, 1000);
  EXPECT_NEAR(result.impacts[0].overload, 1000.0 / 4e4, 1e-12) << "far too weak, yet it broke";
}

TEST_F(Import, OneFileMayHoldAllFragments) {
  TriangleMesh both = slab(box_.low.x(), 0.1);
  const TriangleMesh right = slab(0.1 + 1e-9, box_.high.x());
  const auto offset = static_cast<std::int32_t>(both.vertices.size());
  for (const auto& face : right.faces) {
    both.faces.push_back({face[0] + offset, face[1] + offset, face[2] + offset});
  }
  both.vertices.insert(both.vertices.end(), right.vertices.begin(), right.vertices.end());
  write_mesh(add("one") / "all.obj", both);
  EXPECT_EQ(run("one").fragments.size(), 2u);
}

TEST_F(Import, EveryCollisionHasItsOwnFragments) {
  write_mesh(add("other") / "a.obj", slab(box_.low.x(), -0.5));
  write_mesh(add("other") / "b.obj", slab(-0.5, 0.5));
  write_mesh(add("other") / "c.obj", slab(0.5, box_.high.x()));
  EXPECT_EQ(run("cut").fragments.size(), 2u);
  EXPECT_EQ(run("other").fragments.size(), 3u);
}

TEST_F(Import, FragmentsOfAnotherScaleOrThatAreNoneAreTold) {
  write_mesh(add("large") / "a.obj", slab(-10, 10));
  EXPECT_NE(failure("large").find("longest_side = 0"), std::string::npos) << failure("large");
  std::ofstream(add("bad") / "a.obj") << "v 0 0 nan\n";
  EXPECT_NE(failure("bad").find("a.obj"), std::string::npos);
  add("empty");
  EXPECT_NE(failure("empty").find("empty"), std::string::npos);
}

TEST_F(Import, ItsFilesArePartOfTheKeys) {
  const Options options(method_.options(), {{"path", root_.string()}}, "test");
  EXPECT_EQ(method_.files(options).size(), 3u);
  EXPECT_THROW(method_.load({}, {}, Options(method_.options(), {}, "test")), InputError);
}

}  // namespace
}  // namespace fracbench::test
