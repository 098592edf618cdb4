#include "methods/modes/model.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <set>

#include "core/array_file.h"
#include "core/error.h"
#include "scenarios/break_test.h"
#include "scenarios/given_impact.h"
#include "tests/methods/cvd/bodies.h"
#include "tests/methods/cvd/check_pieces.h"
#include "tests/methods/modes/made_up_modes.h"

namespace fracbench {
namespace {

using namespace modes;

/// A sphere in a block of tets, with pieces of every size.
struct Sphere {
  Target target{"sphere", test::sphere(4), {}};
  TetMesh tets;
  FractureModes found;
  ModelData data;

  Sphere() {
    Random random(9);
    tets = test::shaken(test::tet_block({5, 5, 5}, Vec3::Constant(-1.1), Vec3::Constant(1.1)), 0.1,
                        random);
    found = test::made_up_modes(tets, {test::slabs(tets, 2), test::voronoi_regions(tets, 4, random),
                                       test::voronoi_regions(tets, 7, random)});
    data = test::model_data(target, tets, found, {.minimum_volume = 4e-3});
  }
};

const Sphere& sphere() {
  static const Sphere made;
  return made;
}

std::unique_ptr<ModesBody> body(const Strength& strength = {}) {
  return std::make_unique<ModesBody>(
      std::make_shared<Model>(sphere().target, sphere().data, strength));
}

std::vector<Piece> broken(const Breakable& body, const Impact& impact, int threads = 1) {
  test::Surroundings surroundings;
  Context context = surroundings.context(threads);
  return body.fracture(impact, context);
}

Impact push(double impulse, const Vec3& point = Vec3(0.95, 0, 0),
            BreakTest test = BreakTest::authors) {
  return impact_at(sphere().target, point, -point, impulse, test);
}

constexpr double kCritical = 4e4;  // N s: 1e7 N for 1/250 s

TEST(ModesBody, BreaksIntoSolidsThatFillTheBody) {
  const auto pieces = broken(*body(), push(10 * kCritical));
  ASSERT_GE(pieces.size(), 3u);
  test::expect_filled(sphere().target.mesh, pieces);
}

TEST(ModesBody, StaysWholeAndUncutBelowTheCriticalImpulse) {
  for (const Vec3& point : {Vec3(0.95, 0, 0), Vec3(0, 0.95, 0), Vec3(-0.5, -0.5, 0.63)}) {
    const auto pieces = broken(*body(), push(0.99 * kCritical, point));
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_EQ(pieces[0].mesh.vertices, sphere().target.mesh.vertices);
    EXPECT_EQ(pieces[0].mesh.faces, sphere().target.mesh.faces);
    for (std::size_t f = 0; f < pieces[0].faces.size(); ++f) {
      EXPECT_EQ(pieces[0].faces[f].parent_face, static_cast<std::int32_t>(f));
    }
  }
}

TEST(ModesBody, BreaksWhereTheBreakTestDoesAndIntoMorePiecesFromThereOn) {
  for (const Vec3& point : {Vec3(0.95, 0, 0), Vec3(0, 0.95, 0), Vec3(-0.5, -0.5, 0.63)}) {
    std::size_t before = 1;
    for (double impulse = 0.5 * kCritical; impulse < 1e6 * kCritical; impulse *= 1.7) {
      const Impact impact = push(impulse, point);
      const auto pieces = broken(*body(), impact);
      const bool breaks = fracbench::breaks(BreakTest::authors, impact.break_test, Material{});
      EXPECT_EQ(pieces.size() > 1, breaks) << impulse;
      EXPECT_GE(pieces.size(), before) << impulse;
      before = pieces.size();
    }
    EXPECT_EQ(before, sphere().data.cut.cells.size());
  }
}

TEST(ModesBody, FollowsTheOtherBreakTestsToo) {
  for (const auto test : {BreakTest::authors, BreakTest::eq2_face, BreakTest::eq2_patch}) {
    for (double impulse = 1; impulse < 1e6; impulse *= 2.7) {
      const Impact impact = push(impulse, Vec3(0.95, 0, 0), test);
      const bool breaks = fracbench::breaks(test, impact.break_test, Material{});
      EXPECT_EQ(broken(*body(), impact).size() > 1, breaks) << name_of(test) << ", " << impulse;
    }
  }
}

TEST(ModesBody, WithARawThresholdComparesVelocities) {
  const Impact impact = push(100);
  const auto& data = sphere().data;
  std::vector<std::int32_t> all(data.cut.cells.size());
  std::iota(all.begin(), all.end(), 0);
  const double parting = parting_jump(
      data.projection, all, piece_velocities(data.projection, all, impact.impulses, 1000));
  EXPECT_EQ(broken(*body({.raw = true, .raw_threshold = 1.001 * parting}), impact).size(), 1u);
  EXPECT_GE(broken(*body({.raw = true, .raw_threshold = 0.999 * parting}), impact).size(), 2u);
  EXPECT_EQ(broken(*body({.raw = true, .raw_threshold = 0}), impact).size(), all.size());
}

// Every piece may break on until only atomic pieces are left, and each break fills its piece.
TEST(ModesBody, BreaksAgainAlongTheRemainingInterfaces) {
  const auto first = broken(*body(), push(1.01 * kCritical));
  ASSERT_GE(first.size(), 2u);
  std::size_t atoms = 0;
  std::vector<Piece> left(first.begin(), first.end());
  bool again = false;
  while (!left.empty()) {
    const Piece piece = left.back();
    left.pop_back();
    if (piece.next == nullptr) {
      ++atoms;
      continue;
    }
    const Vec3 center = piece.mesh.corner(0, 0);
    Impact impact = push(50 * kCritical);
    impact.impulses[0].point = center;
    const auto parts = broken(*piece.next, impact);
    ASSERT_GE(parts.size(), 2u);
    test::expect_filled(piece.mesh, parts);
    left.insert(left.end(), parts.begin(), parts.end());
    again = true;
  }
  EXPECT_TRUE(again);
  EXPECT_EQ(atoms, sphere().data.cut.cells.size());
}

TEST(ModesBody, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto one = broken(*body(), push(5 * kCritical), 1);
  const auto four = broken(*body(), push(5 * kCritical), 4);
  EXPECT_EQ(test::digest(one), test::digest(four));
}

TEST(ModesBody, RefusesAnImpulseOffTheSurface) {
  Impact impact = push(10 * kCritical);
  impact.impulses[0].point = Vec3(1.1, 0, 0);
  try {
    broken(*body(), impact);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("1.1,0,0"), std::string::npos) << error.what();
  }
  impact.impulses[0].point = Vec3(0, 0, 0);
  EXPECT_THROW(broken(*body(), impact), InputError);
  impact.impulses[0].point = Vec3(0, 0, std::nan(""));
  EXPECT_THROW(broken(*body(), impact), InputError);
}

TEST(ModesBody, WithoutImpulsesStaysWhole) { EXPECT_EQ(broken(*body(), Impact{}).size(), 1u); }

class ModelFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() /
             ("fracbench_modes_" + std::to_string(::getpid()) + "_" +
              ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::string bytes() const {
    std::ifstream stream(folder / "model.fracbench", std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void replace(const std::string& with) const {
    std::ofstream(folder / "model.fracbench", std::ios::binary) << with;
  }
  std::string load_error(const Target& target = sphere().target,
                         const std::string& settings = "by hand") const {
    try {
      load_model(folder, target, settings);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder;
};

TEST_F(ModelFile, GivesTheSameBodyAndTheSameBytesAgain) {
  body()->save(folder);
  const std::string first = bytes();
  const ModesBody loaded(std::make_shared<Model>(
      sphere().target, load_model(folder, sphere().target, "by hand"), Strength{}));
  for (const double impulse : {1.1, 3.0, 30.0}) {
    EXPECT_EQ(test::digest(broken(loaded, push(impulse * kCritical))),
              test::digest(broken(*body(), push(impulse * kCritical))));
  }
  loaded.save(folder);
  EXPECT_EQ(bytes(), first);
}

TEST_F(ModelFile, OfAnotherBodyOrOtherSettingsIsRefused) {
  body()->save(folder);
  EXPECT_EQ(load_error(), "");
  EXPECT_NE(load_error(sphere().target, "others").find("others"), std::string::npos);
  Target other = sphere().target;
  other.mesh.vertices[0].x() += 1e-9;
  EXPECT_NE(load_error(other).find("sphere"), std::string::npos);
}

TEST_F(ModelFile, ThatIsDamagedCutShortOrMissingIsRefused) {
  body()->save(folder);
  const std::string whole = bytes();
  ASSERT_EQ(load_error(), "");
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, std::size_t{64},
                                   std::size_t{70}, whole.size() / 2, whole.size() - 1}) {
    replace(whole.substr(0, length));
    EXPECT_NE(load_error().find("damaged"), std::string::npos) << length;
  }
  Random random(2);
  for (int n = 0; n < 20; ++n) {
    std::string damaged = whole;
    damaged[random.below(damaged.size())] ^= 4;
    replace(damaged);
    EXPECT_NE(load_error().find("damaged"), std::string::npos);
  }
  std::filesystem::remove(folder / "model.fracbench");
  EXPECT_NE(load_error().find("model.fracbench"), std::string::npos);
}

// The check sum fits, but the numbers do not.
constexpr ArrayFileKind kKind{.format = "fracbench modes", .version = 1};
TEST_F(ModelFile, WithIndicesOutOfRangeIsRefused) {
  body()->save(folder);
  const ArrayFile good = read_array_file(folder / "model.fracbench", kKind);
  for (const auto& [name, values] : good.integers) {
    ArrayFile bad = good;
    bad.integers[name].back() = 1 << 30;
    write_array_file(folder / "model.fracbench", bad, kKind);
    if (name == "cut/region" || name == "mode_pieces") continue;  // any number will do
    EXPECT_NE(load_error().find(name), std::string::npos) << name;
    bad.integers.erase(name);
    write_array_file(folder / "model.fracbench", bad, kKind);
    EXPECT_NE(load_error().find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace fracbench
