#include "methods/modes/modes.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "methods/modes/validation/impact_cases.h"
#include "methods/registry.h"
#include "scenarios/given_impact.h"
#include "tests/methods/cvd/bodies.h"
#include "tests/methods/cvd/check_pieces.h"
#include "tests/methods/modes/made_up_modes.h"

// The method from the mesh to the fragments, with modes that are computed.
namespace fracbench {
namespace {

const Method& method() { return find_method("modes"); }

OptionMap small(OptionMap more = {}) {
  OptionMap given = {{"modes", std::int64_t{4}}, {"cage_faces", std::int64_t{300}}};
  for (auto& [name, value] : more) given.insert_or_assign(name, value);
  return given;
}

std::unique_ptr<Breakable> prepare(const Target& target, const OptionMap& given, int threads = 1) {
  test::Surroundings surroundings;
  Context context = surroundings.context(threads);
  return method().prepare(target, {}, Options(method().options(), given, "test"), context);
}

std::vector<Piece> broken(const Breakable& body, const Target& target, double impulse) {
  test::Surroundings surroundings;
  Context context = surroundings.context();
  const Vec3 point = target.mesh.corner(0, 0);
  return body.fracture(impact_at(target, point, -point, impulse), context);
}

std::string refusal(const Target& target, const OptionMap& given) {
  try {
    prepare(target, given);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// A bar of 4 x 1 x 1, so coarse that it is its own cage.
Target bar() {
  Target target{"bar", test::boxes(4, 1, 1, [](int, int, int) { return true; }), {}};
  return target;
}

TEST(ModesMethod, BreaksBodiesOfEveryKindIntoSolidsThatFillThem) {
  for (auto& [name, mesh] : test::generated_bodies()) {
    SCOPED_TRACE(name);
    const Target target{name, mesh, {}};
    const auto body = prepare(target, small());
    const auto pieces = broken(*body, target, 1e9);
    EXPECT_GE(pieces.size(), 2u);
    test::expect_filled(target.mesh, pieces);
    for (const Piece& piece : pieces) EXPECT_TRUE(check_mesh(piece.mesh).is_solid());
    EXPECT_EQ(broken(*body, target, 1e3).size(), 1u);
  }
}

TEST(ModesMethod, CutsABarInTheMiddleFirst) {
  const Target target = bar();
  const auto body = prepare(target, {{"modes", std::int64_t{1}}, {"tets", std::int64_t{600}}});
  const auto pieces = broken(*body, target, 1e9);
  ASSERT_EQ(pieces.size(), 2u);
  for (const Piece& piece : pieces) {
    EXPECT_NEAR(volume(piece.mesh) / volume(target.mesh), 0.5, 0.1);
  }
}

TEST(ModesMethod, MakesNoMoreFragmentsThanWantedAndNoneBelowTheMinimum) {
  const Target target{"sphere", test::sphere(3), {}};
  for (const std::int64_t wanted : {2, 3, 5}) {
    const auto pieces = broken(
        *prepare(target, small({{"modes", std::int64_t{6}}, {"fragments", wanted}})), target, 1e12);
    EXPECT_EQ(pieces.size(), static_cast<std::size_t>(wanted));
  }
  const auto large = broken(*prepare(target, small({{"minimum_volume", 0.1}})), target, 1e12);
  for (const Piece& piece : large) EXPECT_GE(volume(piece.mesh), 0.1 * volume(target.mesh));
}

TEST(ModesMethod, GivesTheSameBytesForAnyNumberOfThreads) {
  const Target target{"sphere", test::sphere(3), {}};
  EXPECT_EQ(test::digest(broken(*prepare(target, small(), 1), target, 1e6)),
            test::digest(broken(*prepare(target, small(), 3), target, 1e6)));
}

TEST(ModesMethod, LoadsWhatItSaved) {
  const Target target{"sphere", test::sphere(3), {}};
  const auto folder = std::filesystem::temp_directory_path() /
                      ("fracbench_modes_method_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto body = prepare(target, small());
  body->save(folder);
  const auto load = [&](const OptionMap& given) {
    return method().load(folder, target, Options(method().options(), given, "test"));
  };
  EXPECT_EQ(test::digest(broken(*load(small()), target, 1e6)),
            test::digest(broken(*body, target, 1e6)));
  // The threshold is no part of what was prepared.
  EXPECT_GE(
      broken(*load(small({{"threshold", std::string("raw")}, {"raw_threshold", 0.0}})), target, 1)
          .size(),
      2u);
  EXPECT_THROW(load(small({{"modes", std::int64_t{5}}})), InputError);
  std::filesystem::remove_all(folder);
  EXPECT_THROW(load(small()), InputError);
}

TEST(ModesMethod, RefusesOptionsThatContradictEachOther) {
  const Target target = bar();
  const auto mentions = [&](const OptionMap& given, const std::string& word) {
    const std::string said = refusal(target, given);
    EXPECT_NE(said.find(word), std::string::npos) << said;
  };
  mentions({{"dimension", std::int64_t{2}}}, "dimension");
  mentions({{"dimension", std::int64_t{1}}, {"elastic", true}}, "elastic");
  mentions({{"settings", std::string("paper")}, {"modes", std::int64_t{61}}}, "5 to 60");
  mentions({{"settings", std::string("paper-fine")}, {"modes", std::int64_t{11}}}, "paper-fine");
}

class ImpactCase : public ::testing::TestWithParam<ValidationCase> {};

TEST_P(ImpactCase, AgreesWithItsClosedForm) {
  test::Surroundings surroundings;
  Context context = surroundings.context();
  for (const Accuracy& a : GetParam().run(context)) {
    EXPECT_TRUE(a.pass()) << a.name << ": " << a.computed << " for " << a.expected;
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, ImpactCase, ::testing::ValuesIn(modes::impact_validation_cases()),
                         [](const auto& of) {
                           std::string name = of.param.name;
                           std::erase(name, '-');
                           return name;
                         });

TEST(ModesMethod, RefusesMoreModesThanTheTetsHave) {
  const Target target = bar();
  EXPECT_NE(refusal(target, {{"modes", std::int64_t{900}}}), "");
}

}  // namespace
}  // namespace fracbench
