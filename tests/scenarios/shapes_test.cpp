#include "scenarios/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "geometry/write_mesh.h"
#include "scenarios/shapes/generated_shapes.h"
#include "scenarios/shapes/paper_shapes.h"
#include "source_folder.h"

namespace fracbench {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// A folder of its own for each test, and the environment as it was afterwards.
class Shapes : public testing::Test {
 protected:
  Shapes() {
    folder_ = fs::temp_directory_path() /
              (std::string("fracbench_shapes_") + std::to_string(::getpid()) + "_" +
               testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    for (const char* name : {"FRACBENCH_SHAPES", "FRACBENCH_DATA"}) {
      const char* value = std::getenv(name);
      before_.emplace_back(name, value != nullptr ? value : "");
      unsetenv(name);
    }
  }
  ~Shapes() override {
    fs::remove_all(folder_);
    for (const auto& [name, value] : before_) {
      value.empty() ? unsetenv(name.c_str()) : setenv(name.c_str(), value.c_str(), 1);
    }
  }

  fs::path write(const std::string& file, const TriangleMesh& mesh) const {
    write_mesh(folder_ / file, mesh);
    return folder_ / file;
  }

  fs::path folder_;

 private:
  std::vector<std::pair<std::string, std::string>> before_;
};

std::string message_of(const ShapeRequest& request) {
  try {
    load_shape(request);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const ShapeInfo& info(const std::vector<ShapeInfo>& shapes, std::string_view name) {
  const auto found = std::find_if(shapes.begin(), shapes.end(),
                                  [&](const ShapeInfo& shape) { return shape.name == name; });
  if (found == shapes.end()) throw std::logic_error("not listed");
  return *found;
}

TriangleMesh flipped(TriangleMesh mesh) {
  for (Face& face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::int32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Face& f : b.faces) a.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
  return a;
}

/// Every face with three vertices of its own.
TriangleMesh torn(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto first = static_cast<std::int32_t>(result.vertices.size());
    for (int k = 0; k < 3; ++k) result.vertices.push_back(mesh.corner(f, k));
    result.faces.push_back({first, first + 1, first + 2});
  }
  return result;
}

TEST_F(Shapes, GeneratedOnesAreCentredAndOfTheSizeAsked) {
  for (const GeneratedShape& generated : generated_shapes()) {
    for (const double size : {1.9, 1.0}) {
      const Shape shape = load_shape({.name = std::string(generated.name), .longest_side = size});
      const BoundingBox box = bounding_box(shape.mesh);
      EXPECT_NEAR(box.longest_side(), size, 2e-6) << generated.name;
      EXPECT_NEAR(box.center().norm(), 0, 3e-6) << generated.name;
      EXPECT_EQ(shape.name, generated.name);
      EXPECT_TRUE(check_mesh(shape.mesh).is_solid()) << generated.name;
    }
  }
}

TEST_F(Shapes, GeneratedOnesAreListedAsAvailable) {
  const std::vector<ShapeInfo> shapes = list_shapes();
  for (const GeneratedShape& generated : generated_shapes()) {
    EXPECT_TRUE(info(shapes, generated.name).available);
    EXPECT_EQ(info(shapes, generated.name).source, "generated");
  }
}

TEST_F(Shapes, ResolutionsOutOfRangeAreRefusedWithTheRange) {
  EXPECT_THAT(message_of({.name = "mug", .resolution = 3}), HasSubstr("from 16 to 400"));
  EXPECT_THAT(message_of({.name = "cube", .resolution = -1}), HasSubstr("resolution -1"));
  EXPECT_THAT(message_of({.name = "cube", .resolution = 5000}), HasSubstr("from 1 to 400"));
}

TEST_F(Shapes, UnknownNamesGetTheNearestOne) {
  EXPECT_THAT(message_of({.name = "sqirrel"}), HasSubstr("did you mean 'squirrel'"));
  EXPECT_THAT(message_of({.name = "nothing-like-it"}), HasSubstr("chair"));
  EXPECT_THAT(message_of({.name = "missing.obj"}), HasSubstr("missing.obj"));
}

TEST_F(Shapes, SizesThatAreNoneAreRefused) {
  EXPECT_THAT(message_of({.name = "cube", .longest_side = -1}), HasSubstr("-1 m"));
  EXPECT_THAT(message_of({.name = "cube", .longest_side = std::nan("")}), HasSubstr("nan m"));
}

TEST_F(Shapes, ASolidFileIsOnlyScaled) {
  TriangleMesh mesh = sphere_mesh(10);
  for (Vec3& v : mesh.vertices) v = 10 * v + Vec3(5, 6, 7);
  const std::string file = write("my ball.obj", mesh).string();
  const Shape scaled = load_shape({.name = file});
  EXPECT_EQ(scaled.name, "my ball");
  EXPECT_NEAR(bounding_box(scaled.mesh).longest_side(), 1.9, 1e-12);
  EXPECT_EQ(scaled.mesh.faces, mesh.faces);
  ASSERT_EQ(scaled.notes.size(), 1u);
  EXPECT_THAT(scaled.notes[0], HasSubstr("scaled by 0.095"));
  const Shape kept = load_shape({.name = file, .longest_side = 0});
  EXPECT_EQ(kept.mesh.vertices, mesh.vertices);
  EXPECT_TRUE(kept.notes.empty());
}

TEST_F(Shapes, TornVerticesAreWeldedAndThatIsSaid) {
  const TriangleMesh mesh = generated_shapes()[7].make(4);
  const Shape shape = load_shape({.name = write("torn.ply", torn(mesh)).string()});
  EXPECT_EQ(shape.mesh.vertices.size(), mesh.vertices.size());
  ASSERT_FALSE(shape.notes.empty());
  EXPECT_THAT(shape.notes[0], HasSubstr("weld"));
}

TEST_F(Shapes, FacesWoundAgainstTheirNeighboursAreTurnedAndThatIsSaid) {
  TriangleMesh mesh = sphere_mesh(10);
  const double expected = volume(mesh);
  for (std::size_t f = 0; f < mesh.faces.size(); f += 7)
    std::swap(mesh.faces[f][0], mesh.faces[f][1]);
  const Shape shape = load_shape({.name = write("mixed.obj", mesh).string(), .longest_side = 0});
  EXPECT_NEAR(volume(shape.mesh), expected, 1e-12);
  EXPECT_FALSE(shape.notes.empty());
}

TEST_F(Shapes, InvertedMeshesAreRefusedAndNotTurned) {
  const TriangleMesh ball = sphere_mesh(10);
  EXPECT_THAT(message_of({.name = write("inverted.obj", flipped(ball)).string()}),
              HasSubstr("inverted"));
  EXPECT_THAT(message_of({.name = write("torn.ply", torn(flipped(ball))).string()}),
              HasSubstr("inverted"));
  // A shell within another one that is not turned like a cavity, and one of two that is inside out.
  TriangleMesh small = ball, far = flipped(ball);
  for (Vec3& v : small.vertices) v *= 0.5;
  for (Vec3& v : far.vertices) v += Vec3(5, 0, 0);
  EXPECT_THAT(message_of({.name = write("nested.obj", joined(ball, small)).string()}),
              HasSubstr("inverted"));
  EXPECT_THAT(message_of({.name = write("pair.obj", joined(ball, far)).string()}),
              HasSubstr("inverted"));
  EXPECT_EQ(message_of({.name = write("hollow.obj", joined(ball, flipped(small))).string()}), "");
}

TEST_F(Shapes, WhatIsNoSolidIsRefusedWithThePlace) {
  TriangleMesh open = sphere_mesh(10);
  open.faces.pop_back();
  EXPECT_THAT(message_of({.name = write("open.obj", open).string()}), HasSubstr("open edge"));
  TriangleMesh moved = sphere_mesh(10);
  for (Vec3& v : moved.vertices) v += Vec3(0.5, 0.1, 0.2);
  const std::string crossing = write("crossing.obj", joined(sphere_mesh(10), moved)).string();
  EXPECT_THAT(message_of({.name = crossing}), HasSubstr("intersect"));
  EXPECT_THAT(message_of({.name = crossing}), HasSubstr("crossing.obj"));
  std::ofstream(folder_ / "garbage.stl") << "\x01\x02 nothing";
  EXPECT_NE(message_of({.name = (folder_ / "garbage.stl").string()}), "");
}

TEST_F(Shapes, TheBunnyComesFromTheDataFolder) {
  setenv("FRACBENCH_DATA", folder_.c_str(), 1);
  EXPECT_FALSE(info(list_shapes(), "bunny").available);
  EXPECT_THAT(message_of({.name = "bunny"}), HasSubstr("install.sh"));
  write("bunny.obj", sphere_mesh(10));
  EXPECT_TRUE(info(list_shapes(), "bunny").available);
  EXPECT_EQ(load_shape({.name = "bunny"}).name, "bunny");
}

TEST_F(Shapes, ThePapersShapesSayWhereTheyComeFromWhenAbsent) {
  const std::vector<ShapeInfo> shapes = list_shapes();
  for (const PaperShape& shape : paper_shapes()) {
    EXPECT_FALSE(info(shapes, shape.name).available);
    EXPECT_THAT(info(shapes, shape.name).how_to_get, HasSubstr(std::to_string(shape.thing)));
    EXPECT_THAT(message_of({.name = std::string(shape.name)}),
                HasSubstr(std::to_string(shape.thing)));
  }
  EXPECT_THAT(message_of({.name = "squirrel"}), HasSubstr("37384"));
  EXPECT_THAT(message_of({.name = "squirrel"}), HasSubstr("FRACBENCH_SHAPES is not set"));
  setenv("FRACBENCH_SHAPES", folder_.c_str(), 1);
  write("squirrel.obj", sphere_mesh(10));  // the name alone does not count
  EXPECT_THAT(message_of({.name = "squirrel"}), HasSubstr("has its proportions"));
}

TEST_F(Shapes, ThePapersShapesAreRecognisedByContent) {
  const fs::path shared = fs::path(FRACBENCH_SOURCE_DIR) / ".." / "shared" / "meshes";
  if (!fs::exists(shared / "squirrel.obj")) GTEST_SKIP() << "no folder " << shared;
  // Under other names, turned and scaled.
  TriangleMesh mesh = load_shape({.name = (shared / "squirrel.obj").string()}).mesh;
  for (Vec3& v : mesh.vertices) v = 30 * Vec3(v.y(), v.z(), v.x()) + Vec3(1, 2, 3);
  write("one of many.ply", mesh);
  setenv("FRACBENCH_SHAPES", folder_.c_str(), 1);
  EXPECT_NEAR(volume(load_shape({.name = "squirrel"}).mesh), 1.58142, 1e-4);
  EXPECT_FALSE(info(list_shapes(), "base").available);

  setenv("FRACBENCH_SHAPES", shared.c_str(), 1);
  const std::vector<ShapeInfo> shapes = list_shapes();
  for (const char* name : {"squirrel", "base", "bunny-paper"}) {
    EXPECT_TRUE(info(shapes, name).available) << name;
  }
  EXPECT_FALSE(info(shapes, "pot-paper").available);
  EXPECT_NEAR(volume(load_shape({.name = "squirrel"}).mesh), 1.58142, 1e-5);
  EXPECT_NEAR(volume(load_shape({.name = "base"}).mesh), 0.68150, 1e-5);
  EXPECT_EQ(load_shape({.name = "bunny-paper"}).mesh.faces.size(), 15774u);
}

}  // namespace
}  // namespace fracbench
