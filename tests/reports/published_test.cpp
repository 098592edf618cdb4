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
    EXPECT_TRUE(result.try_emplace({time.shape, time.resolution, time.stage}, time.seconds).second);
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
  EXPECT_NEAR(table.at({"squirrel", "", "simulation"}), 15.5 * 60, 1e-9);
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

}  // namespace
}  // namespace fracbench
