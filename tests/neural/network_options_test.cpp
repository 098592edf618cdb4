#include "neural/network_options.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace fracbench::neural {
namespace {

// The paper: 47 million parameters, files of 185 to 190 MB, storage of the multi-resolution model
// about 1 % larger (sections 6.2 and 6.4).
TEST(NetworkOptions, AtFullWidthHaveThePapersNumberOfParameters) {
  EXPECT_EQ(parameter_count({.resolutions = {128}}), 46'929'216u);
  EXPECT_EQ(parameter_count({.resolutions = {256}}), 47'058'336u);
  const double megabytes = 4.0 * static_cast<double>(parameter_count({.resolutions = {256}})) / 1e6;
  EXPECT_GT(megabytes, 185);
  EXPECT_LT(megabytes, 190);
  const double all = static_cast<double>(parameter_count({.resolutions = {32, 64, 128, 256}}));
  EXPECT_LT(all / static_cast<double>(parameter_count({.resolutions = {256}})), 1.01);
  EXPECT_EQ(weight_specs({}).front().size(), 35'651'584u);  // 35.9 M with the bias
}

TEST(NetworkOptions, PlaceEachOutputBehindTheFeaturesOfHalfItsSide) {
  const NetworkOptions all{.resolutions = {32, 64, 128, 256}};
  const auto heads = decoder_heads(all);
  ASSERT_EQ(heads.size(), 4u);
  const int in[] = {256, 128, 64, 32};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(2 * heads[k].side, all.resolutions[k]);
    EXPECT_EQ(heads[k].in, in[k]);
  }
  EXPECT_EQ(decoder_blocks({.resolutions = {32}}).size(), 1u);
  EXPECT_EQ(decoder_blocks({.resolutions = {64}, .width = 0.25})[1].out, 32);
}

TEST(NetworkOptions, SurviveJson) {
  const NetworkOptions options{.resolutions = {32, 128},
                               .width = 0.125,
                               .features = 2,
                               .impulse_code = 64,
                               .segment_code = 3,
                               .omega = 2,
                               .slope = 0.1,
                               .normalisation = Normalisation::group,
                               .statistics = Statistics::reestimated,
                               .epsilon = 0.8};
  EXPECT_EQ(network_options_from_json(to_json(options)), options);
}

TEST(NetworkOptions, OutOfRangeAreRefused) {
  for (const NetworkOptions& bad : {NetworkOptions{.resolutions = {}},
                                    {.resolutions = {48}},
                                    {.resolutions = {64, 32}},
                                    {.width = 0},
                                    {.features = 3},
                                    {.impulse_code = 0},
                                    {.epsilon = 0},
                                    {.slope = 1}}) {
    EXPECT_THROW(check(bad), InputError);
  }
}

}  // namespace
}  // namespace fracbench::neural
