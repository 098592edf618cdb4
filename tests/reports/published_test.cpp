#include "reports/published.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace fracbench {
namespace {

std::map<std::tuple<std::string, std::string, std::string>, double> seconds() {
  std::map<std::tuple<std::string, std::string, std::string>, double> result;
  for (const PublishedTime& time : published_times()) {
    EXPECT_TRUE(
        result
            .try_emplace({time.shape, std::to_string(time.stage.resolution), time.stage.stage},
                         time.seconds)
            .second);
  }
  return result;
}

TEST(PublishedTimes, are_complete) {
  // Five rows of eleven columns, six of which have two resolutions.
  EXPECT_EQ(published_times().size(), 5u * (5 + 2 * 6));
}

TEST(PublishedTimes, obey_the_sums_that_hold_in_the_table) {
  const auto table = seconds();
  for (const char* shape : {"pot", "bunny", "base", "squirrel"}) {
    for (const char* r : {"128", "256"}) {
      const auto at = [&](const char* stage) { return table.at({shape, r, stage}); };
      EXPECT_NEAR(at("prediction") + at("segmentation") + at("boolean"), at("reconstruction"),
                  1e-9);
      EXPECT_NEAR(at("reconstruction") + at("others"), at("total"), 0.051) << shape << r;
    }
  }
  EXPECT_NEAR(table.at({"squirrel", "0", "simulation"}), 15.5 * 60, 1e-9);
}

TEST(PublishedErrata, have_names_and_consequences) {
  std::set<std::string> names;
  for (const Erratum& erratum : published_errata()) {
    EXPECT_TRUE(names.insert(erratum.name).second);
    EXPECT_FALSE(erratum.place.empty() || erratum.finding.empty() || erratum.consequence.empty());
  }
  EXPECT_EQ(names.size(), 8u);
  EXPECT_TRUE(names.contains("mott-formula"));
}

TEST(PublishedErrata, that_values_name_are_there) {
  std::set<std::string> names{""};
  for (const Erratum& erratum : published_errata()) names.insert(erratum.name);
  for (const PublishedTime& time : published_times()) EXPECT_TRUE(names.contains(time.erratum));
  for (const PublishedRatio& r : published_ratios()) EXPECT_TRUE(names.contains(r.erratum));
  for (const PublishedMethod& m : published_methods()) EXPECT_TRUE(names.contains(m.erratum));
  for (const Claim& claim : published_claims().list) EXPECT_TRUE(names.contains(claim.erratum));
}

TEST(PublishedRatios, follow_from_the_times) {
  for (const PublishedRatio& ratio : published_ratios()) {
    for (const char* shape : {"pot", "bunny", "base", "squirrel", "mean"}) {
      EXPECT_TRUE(published_value(ratio, shape, published_times())) << ratio.name << shape;
    }
    EXPECT_FALSE(published_value(ratio, "teapot", published_times()));
  }
  // 15.5 min over 8.72 s.
  EXPECT_NEAR(published_value(published_ratios().front(), "squirrel", published_times()).value(),
              106.65, 0.01);
}

TEST(PublishedMethods, are_the_five_of_table_1) {
  const auto methods = published_methods();
  ASSERT_EQ(methods.size(), 5u);
  EXPECT_EQ(methods[0].method, "bem");
  EXPECT_FALSE(methods[0].retains_surface);
  EXPECT_TRUE(methods[4].method.empty());
}

}  // namespace
}  // namespace fracbench
