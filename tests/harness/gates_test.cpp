#include "harness/gates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace fracbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string complaint(const std::string& text) {
  try {
    parse_gates(text, "gates.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Gates, AreReadWithAllTheirKeys) {
  const auto gates = parse_gates(
      "[[gate]]\nmetric = \"fragment_count\"\nfactor = 1.2\nmethod = \"cvd\"\nshape = \"pot\"\n"
      "direction = \"lower\"\nsignificance = 0.05\n"
      "[[gate]]\nmetric = \"fragment_volume\"\ntest = \"ks\"\nchange = 0.2\nraise_to_noise = true\n"
      "[[gate]]\nmetric = \"stage_cut\"\ntest = \"paired-ratio\"\nfactor = 2\n",
      "gates.toml");
  ASSERT_EQ(gates.size(), 3u);
  EXPECT_EQ(gates[0].metric, "fragment_count");
  EXPECT_TRUE(gates[0].relative);
  EXPECT_EQ(gates[0].limit, 1.2);
  EXPECT_EQ(gates[0].method, "cvd");
  EXPECT_EQ(gates[0].shape, "pot");
  EXPECT_EQ(gates[0].direction, Tail::lower);
  EXPECT_EQ(gates[0].significance, 0.05);
  EXPECT_EQ(gates[1].test, GateTest::kolmogorov_smirnov);
  EXPECT_FALSE(gates[1].relative);
  EXPECT_TRUE(gates[1].raise_to_noise);
  EXPECT_TRUE(gates[2].of_machine());
  EXPECT_EQ(gates[2].limit, 2);
}

TEST(Gates, MistakesAreNamedWithFileLineAndTheWayOut) {
  const std::string gate = "[[gate]]\nmetric = \"roughness\"\n";
  EXPECT_THAT(complaint(gate + "facter = 1.1\n"),
              AllOf(HasSubstr("gates.toml:3"), HasSubstr("did you mean 'factor'")));
  EXPECT_THAT(complaint("[[gates]]\nmetric = \"x\"\n"), HasSubstr("did you mean 'gate'"));
  EXPECT_THAT(complaint("[gate]\nmetric = \"x\"\n"), HasSubstr("[[gate]]"));
  EXPECT_THAT(complaint("gate = 3\n"), HasSubstr("[[gate]]"));
  EXPECT_THAT(complaint(""), HasSubstr("nothing could fail"));
  EXPECT_THAT(complaint("gate = []\n"), ::testing::Not(::testing::IsEmpty()));
  EXPECT_THAT(complaint("[[gate]]\nfactor = 1.1\n"), HasSubstr("'metric' is missing"));
  EXPECT_THAT(complaint(gate), HasSubstr("factor = 1.1, or change"));
  EXPECT_THAT(complaint(gate + "factor = 1.1\nchange = 1\n"), HasSubstr("not both"));
  EXPECT_THAT(complaint(gate + "factor = 0.9\n"), HasSubstr("must be above 1"));
  EXPECT_THAT(complaint(gate + "factor = \"big\"\n"), HasSubstr("gates.toml:3"));
  EXPECT_THAT(complaint(gate + "factor = [1]\n"), HasSubstr("gates.toml:3"));
  EXPECT_THAT(complaint(gate + "change = nan\n"), ::testing::Not(::testing::IsEmpty()));
  EXPECT_THAT(complaint(gate + "test = \"ks\"\nfactor = 1.1\n"), HasSubstr("change = 0.1"));
  EXPECT_THAT(complaint(gate + "test = \"kss\"\nchange = 1\n"), HasSubstr("kss"));
  EXPECT_THAT(complaint(gate + "significance = 2\nchange = 1\n"), HasSubstr("significance"));
  EXPECT_THAT(complaint(gate + "test = \"paired-ratio\"\nfactor = 2\n"), HasSubstr("for times"));
  EXPECT_THAT(complaint("[[gate]]\nmetric = \"stage_*\"\nfactor = 2\n"), HasSubstr("for times"));
  EXPECT_THAT(complaint("[[gate"), HasSubstr("gates.toml:1"));
  EXPECT_THROW(read_gates("nowhere.toml"), InputError);
}

TEST(Gates, WithoutAFileCoverStatusCountsVolumesNormalsRoughnessAndTimes) {
  std::vector<std::string> metrics;
  for (const Gate& gate : default_gates()) metrics.push_back(gate.metric);
  EXPECT_THAT(metrics, ::testing::IsSupersetOf({"fragment_count", "fragment_volume", "normal_along",
                                                "roughness", "volume_ratio", "total_seconds"}));
}

}  // namespace
}  // namespace fracbench
