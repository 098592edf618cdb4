#include "harness/learning_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace fracbench {
namespace {

LearningShape made_up_shape(std::size_t broken, std::size_t unbroken = 0, std::size_t failed = 0) {
  LearningShape shape{.label = "pot",
                      .name = "pot",
                      .mesh_digest = "m",
                      .digest = "d",
                      .max_impulse = 0.1 + 0.2,
                      .records = {}};
  const auto add = [&](CellStatus status, LearningRole role) {
    const std::string number = std::to_string(shape.records.size());
    shape.records.push_back({.key = "key" + number,
                             .scenario = "single-" + number,
                             .role = role,
                             .status = status,
                             .impulses = {1.0 / 3, 0.25}});
  };
  for (std::size_t i = 0; i < broken; ++i) add(CellStatus::ok, LearningRole::spare);
  for (std::size_t i = 0; i < unbroken; ++i) add(CellStatus::unbroken, LearningRole::unbroken);
  for (std::size_t i = 0; i < failed; ++i) add(CellStatus::crash, LearningRole::failed);
  return shape;
}

std::map<std::string, LearningRole> roles(const LearningShape& shape) {
  std::map<std::string, LearningRole> result;
  for (const LearningRecord& record : shape.records) result[record.scenario] = record.role;
  return result;
}

TEST(Division, GivesTheNumbersThatAreWantedAndLeavesWhatDidNotBreak) {
  for (const std::uint64_t seed : {1u, 2u, 77u}) {
    LearningShape shape = made_up_shape(260, 30, 10);
    divide(shape, {.train = 200, .test = 50}, seed);
    EXPECT_EQ(shape.count(LearningRole::train), 200u);
    EXPECT_EQ(shape.count(LearningRole::test), 50u);
    EXPECT_EQ(shape.count(LearningRole::spare), 10u);
    EXPECT_EQ(shape.count(LearningRole::unbroken), 30u);
    EXPECT_EQ(shape.count(LearningRole::failed), 10u);
    EXPECT_EQ(shape.broken(), 260u);
  }
}

TEST(Division, OfFewerThanWantedKeepsTheProportion) {
  LearningShape shape = made_up_shape(249, 51);
  divide(shape, {.train = 200, .test = 50, .least = 240}, 1);
  EXPECT_EQ(shape.count(LearningRole::train), 199u);
  EXPECT_EQ(shape.count(LearningRole::test), 50u);
  EXPECT_EQ(shape.count(LearningRole::spare), 0u);
}

TEST(Division, FollowsFromTheSeedAndTheNameOfTheSceneNotFromTheOrder) {
  const LearningSplit split{.train = 12, .test = 8};
  LearningShape one = made_up_shape(20);
  LearningShape two = one;
  std::ranges::reverse(two.records);
  divide(one, split, 3);
  divide(two, split, 3);
  EXPECT_EQ(roles(one), roles(two));
  divide(two, split, 3);  // and what they were before
  EXPECT_EQ(roles(one), roles(two));
  divide(two, split, 4);
  EXPECT_NE(roles(one), roles(two));
  two.label = "mug";
  divide(two, split, 3);
  EXPECT_NE(roles(one), roles(two));
}

TEST(Division, AMissingCollisionChangesTheRoleOfAtMostTwoOthers) {
  const LearningSplit split{.train = 30, .test = 10};
  LearningShape whole = made_up_shape(60);
  divide(whole, split, 1);
  for (std::size_t missing = 0; missing < 60; missing += 7) {
    LearningShape shape = made_up_shape(60);
    shape.records[missing].status = CellStatus::timeout;
    shape.records[missing].role = LearningRole::failed;
    divide(shape, split, 1);
    int changed = 0;
    for (std::size_t i = 0; i < 60; ++i) {
      changed += i != missing && shape.records[i].role != whole.records[i].role;
    }
    EXPECT_LE(changed, 2);
  }
}

TEST(Division, DoesNotPreferEarlyScenesForTests) {
  // Mean number of a test among 0 ... 99 over many seeds: 49.5 with a standard error of 0.6.
  double sum = 0;
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    LearningShape shape = made_up_shape(100);
    divide(shape, {.train = 80, .test = 20}, seed);
    for (std::size_t i = 0; i < 100; ++i) {
      if (shape.records[i].role != LearningRole::test) continue;
      sum += static_cast<double>(i);
      ++count;
    }
  }
  EXPECT_EQ(count, 2000u);
  EXPECT_NEAR(sum / static_cast<double>(count), 49.5, 3);
}

TEST(LearningIndex, ReadsBackFromJsonToTheSameBits) {
  LearningIndex index{.suite = "s",
                      .method = "bem",
                      .method_options = R"({"voxel":0.04})",
                      .family = "single",
                      .seed = 0xfedcba9876543210u,
                      .split = {.train = 3, .test = 1, .least = 2},
                      .shapes = {made_up_shape(3, 2, 1), made_up_shape(1)}};
  index.shapes[1].label = "mug";
  index.shapes[0].records.back().reason = "too thin";
  const auto json = to_json(index);
  const LearningIndex again =
      learning_index_from_json(nlohmann::ordered_json::parse(json.dump()), "learning.json");
  EXPECT_EQ(to_json(again), json);
  EXPECT_EQ(again.seed, index.seed);
  EXPECT_EQ(again.shapes[0].max_impulse, index.shapes[0].max_impulse);
  EXPECT_EQ(again.shapes[0].records.back().reason, "too thin");
  EXPECT_EQ(again.shape("mug", "here").records.size(), 1u);
  EXPECT_THROW(again.shape("jug", "here"), InputError);
}

TEST(LearningIndex, RefusesWhatIsNone) {
  const auto json = to_json(LearningIndex{.suite = "s",
                                          .method = "bem",
                                          .method_options = "{}",
                                          .family = "single",
                                          .split = {},
                                          .shapes = {made_up_shape(2)}});
  std::vector<nlohmann::ordered_json> bad{nullptr, 3, nlohmann::ordered_json::array()};
  for (const char* key : {"version", "seed", "shapes", "train"}) {
    bad.push_back(json);
    bad.back().erase(key);
  }
  bad.push_back(json);
  bad.back()["version"] = 99;
  bad.push_back(json);
  bad.back()["shapes"]["pot"]["records"][0]["role"] = "king";
  for (const auto& value : bad) {
    EXPECT_THROW(learning_index_from_json(value, "learning.json"), InputError) << value.dump();
  }
}

}  // namespace
}  // namespace fracbench
