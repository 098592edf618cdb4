#include "harness/record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "harness/data_file.h"
#include "harness/plan.h"
#include "toy_catalog.h"

namespace fracbench {
namespace {

Impact sample_impact(Random& random, std::size_t impulses) {
  Impact impact;
  for (std::size_t k = 0; k < impulses; ++k) {
    impact.impulses.push_back({random.unit_vector(), random.unit_vector(), random.uniform(),
                               static_cast<std::int32_t>(k), random.unit_vector(), 0.25});
    impact.strikers.push_back({1, 2, 3, 4, random.unit_vector()});
  }
  impact.body.pose.position = random.unit_vector();
  impact.body.pose.orientation.vec() = random.unit_vector();
  impact.body.velocity = random.unit_vector();
  impact.time = random.uniform();
  impact.break_test = {1, 2, 3, 4};
  impact.overload = 1.5;
  impact.fragment = 7;
  return impact;
}

Record sample_record() {
  Random random(1);
  Record record;
  record.key = std::string(64, 'a');
  record.identity = {.method = "halves",
                     .label = "halves-wide",
                     .method_options = "{}",
                     .method_digest = "d",
                     .shape = "box",
                     .shape_digest = "e",
                     .family = "shove",
                     .scenario = "shove-1",
                     .scenario_values = "{\"a\":1}",
                     .repeat = 2,
                     .seed = UINT64_MAX,
                     .prepare_seed = 4,
                     .threads = 2,
                     .source_digest = "f"};
  record.outcome.reason = "größer";
  record.outcome.notes = {"one", "", "three"};
  SceneResult& scene = record.outcome.scene;
  scene.impacts = {sample_impact(random, 3), sample_impact(random, 0), sample_impact(random, 1)};
  scene.unbroken = sample_impact(random, 2);
  for (std::int32_t f = 0; f < 3; ++f) {
    Fragment fragment{.mesh = box_mesh(-random.unit_vector(), Vec3::Ones()), .faces = {}};
    for (std::int32_t k = 0; k < 12; ++k) fragment.faces.push_back({k - 3, k * f});
    fragment.piece = f;
    fragment.parent = f - 1;
    fragment.generation = f + 1;
    scene.fragments.push_back(fragment);
  }
  scene.trajectory.frame_seconds = 0.004;
  scene.trajectory.tracks = {{Track::Kind::ball, 1, 0, std::vector<Pose>(4)},
                             {Track::Kind::piece, 5, 2, {}}};
  scene.trajectory.tracks[0].poses[2].position = random.unit_vector();
  scene.replacements = {{1, 2, 3, 4}, {5, 6, 7, 8}};
  record.outcome.measurement = {{{"volume_ratio", 1 + 1e-15, ""}, {"mean", -0.0, "m"}},
                                {{"volumes", {1, 2, 3}, "m^3"}, {"none", {}, ""}}};
  record.cost.stages = {{"cut", 0.5}, {"metrics", 0.25}};
  record.cost.total_seconds = 0.75;
  record.cost.peak_memory = 1e9;
  record.cost.provenance = {{"cpu", "a processor"}};
  return record;
}

TEST(RecordTest, ComesBackAsItWasBitForBit) {
  const DataTree tree = to_tree(sample_record());
  EXPECT_EQ(to_tree(to_record(tree)), tree);
}

TEST(RecordTest, KeepsEveryPartInItsPlace) {
  const Record record = sample_record();
  const Record back = to_record(to_tree(record));
  EXPECT_EQ(back.identity, record.identity);
  EXPECT_EQ(back.outcome.notes, record.outcome.notes);
  const SceneResult& scene = back.outcome.scene;
  ASSERT_EQ(scene.fragments.size(), 3);
  EXPECT_EQ(scene.fragments[2].mesh.vertices, record.outcome.scene.fragments[2].mesh.vertices);
  EXPECT_EQ(scene.fragments[1].faces, record.outcome.scene.fragments[1].faces);
  EXPECT_EQ(scene.fragments[2].generation, 3);
  ASSERT_EQ(scene.impacts.size(), 3);
  EXPECT_EQ(scene.impacts[0].impulses[2].point, record.outcome.scene.impacts[0].impulses[2].point);
  EXPECT_EQ(scene.impacts[2].body.pose.orientation.coeffs(),
            record.outcome.scene.impacts[2].body.pose.orientation.coeffs());
  EXPECT_EQ(scene.unbroken->impulses.size(), 2);
  EXPECT_EQ(scene.trajectory.tracks[0].poses[2].position,
            record.outcome.scene.trajectory.tracks[0].poses[2].position);
  EXPECT_EQ(scene.replacements[1].energy_ratio, 8);
  EXPECT_EQ(back.outcome.measurement.series[0].values, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(back.cost.stages[1].name, "metrics");
}

TEST(RecordTest, TheResultDigestIsBlindToTheMachineAndSeesTheRest) {
  const Record record = sample_record();
  const std::string digest = result_digest(record);
  Record other = record;
  other.cost.total_seconds = 9;
  other.cost.provenance["cpu"] = "another";
  EXPECT_EQ(result_digest(other), digest);
  other.outcome.scene.fragments[1].mesh.vertices[3].x() += 1e-15;
  EXPECT_NE(result_digest(other), digest);
  other = record;
  other.outcome.measurement.values[1].value = 0.0;
  EXPECT_NE(result_digest(other), digest);
  other = record;
  other.identity.seed = 3;
  EXPECT_NE(result_digest(other), digest);
}

TEST(RecordTest, ASummaryNeedsNeitherMeshesNorTrajectory) {
  DataTree part;
  const DataTree whole = to_tree(sample_record());
  for (const auto& [path, array] : whole.arrays()) {
    if (is_summary_array(path)) part.put_array(path, array);
  }
  const CellSummary summary = to_summary(part);
  EXPECT_EQ(summary.label, "halves-wide");
  EXPECT_EQ(summary.seed, UINT64_MAX);
  EXPECT_EQ(summary.impulses.size(), 3);
  EXPECT_EQ(summary.breaks, 3);
  EXPECT_EQ(summary.cpu, "a processor");
  EXPECT_EQ(summary.total_seconds, 0.75);
  EXPECT_EQ(summary.result_digest, result_digest(sample_record()));
}

TEST(RecordTest, IsRefusedWhereItsDigestDoesNotMatch) {
  const DataTree whole = to_tree(sample_record());
  for (const char* path : {"result/fragments/vertices", "machine/total_seconds"}) {
    DataTree tree = whole;
    DataTree::Array array = tree.arrays().at(path);
    array.bytes[5] ^= std::byte{1};
    tree.put_array(path, array);
    EXPECT_THROW(to_record(tree), DataError) << path;
  }
  DataTree added = whole;
  added.put("result/more", 1.0);
  EXPECT_THROW(to_record(added), DataError);
}

TEST(RecordTest, IsRefusedWhereItIsOfAnotherVersionOrNoRecord) {
  DataTree tree = to_tree(sample_record());
  tree.put("schema_version", std::int64_t{kSchemaVersion + 1});
  EXPECT_THAT([&] { to_record(tree); },
              testing::ThrowsMessage<DataError>(testing::HasSubstr("layout version")));
  EXPECT_THROW(to_record(DataTree()), DataError);
  EXPECT_THROW(to_summary(DataTree()), DataError);
}

TEST(RecordTest, IsRefusedWhereItsNumbersContradictEachOtherWhateverItsDigestSays) {
  const DataTree whole = to_tree(sample_record());
  const auto refused = [&](const char* path, const auto& values, std::size_t columns) {
    DataTree result;
    for (const auto& [name, array] : whole.arrays()) {
      if (name.starts_with("result/")) result.put_array(name.substr(7), array);
    }
    if constexpr (std::is_same_v<typename std::decay_t<decltype(values)>::value_type,
                                 std::uint64_t>) {
      result.put(path, values);
    } else {
      result.put(path, values, columns);
    }
    DataTree tree = whole;
    for (const auto& [name, array] : result.arrays()) tree.put_array("result/" + name, array);
    tree.put("result_digest", std::string_view(result.digest()));
    try {
      to_record(tree);
      return false;
    } catch (const DataError&) {
      return true;
    }
  };
  using Starts = std::vector<std::uint64_t>;
  EXPECT_TRUE(refused("fragments/face_start", Starts({0, 12, 24}), 0));
  EXPECT_TRUE(refused("fragments/vertex_start", Starts({0, 8, 4, 24}), 0));
  EXPECT_TRUE(refused("fragments/vertex_start", Starts({0, 8, 16, UINT64_MAX}), 0));
  EXPECT_TRUE(refused("fragments/faces", std::vector<std::int32_t>(108, 8), 3));
  EXPECT_TRUE(refused("fragments/faces", std::vector<std::int32_t>(108, -1), 3));
  EXPECT_TRUE(refused("impacts/striker", std::vector<double>(7), 7));
  EXPECT_TRUE(refused("impacts/body", std::vector<double>(12), 12));
  EXPECT_TRUE(refused("trajectory/kind", std::vector<std::int32_t>{1, 9}, 0));
  EXPECT_TRUE(refused("metrics/values", std::vector<double>{1}, 0));
}

TEST(RecordTest, LeavesOutTheTargetWhereItDidNotBreak) {
  Record record = sample_record();
  record.outcome.scene.impacts.clear();
  EXPECT_TRUE(to_record(to_tree(record)).outcome.scene.fragments.empty());
}

}  // namespace
}  // namespace fracbench
