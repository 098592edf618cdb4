#include "reports/svg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

namespace fracbench {
namespace {

Figure points(std::vector<double> x, std::vector<double> y, Mark mark = Mark::dots) {
  Figure figure{.name = "f", .title = "F", .x = {.label = "x"}, .y = {.label = "y"}};
  figure.series.push_back({.name = "s", .mark = mark, .x = std::move(x), .y = std::move(y)});
  return figure;
}

struct Place {
  double x, y;
};

std::vector<Place> circles(const std::string& svg) {
  std::vector<Place> places;
  const std::regex circle(R"re(<circle cx="([-0-9.]+)" cy="([-0-9.]+)")re");
  for (std::sregex_iterator i(svg.begin(), svg.end(), circle), end; i != end; ++i) {
    places.push_back({std::stod((*i)[1]), std::stod((*i)[2])});
  }
  return places;
}

TEST(Svg, EqualStepsAreEqualOnALinearAxis) {
  const auto places = circles(to_svg(points({1, 2, 3}, {10, 30, 50})));
  ASSERT_EQ(places.size(), 3u);
  EXPECT_NEAR(places[1].x - places[0].x, places[2].x - places[1].x, 0.11);  // written with 0.1 px
  EXPECT_NEAR(places[1].y - places[0].y, places[2].y - places[1].y, 0.11);
  EXPECT_LT(places[2].y, places[0].y) << "larger values are higher up";
}

TEST(Svg, EqualRatiosAreEqualOnALogarithmicAxis) {
  Figure figure = points({1, 2, 3}, {0.01, 1, 100});
  figure.y.logarithmic = true;
  const auto places = circles(to_svg(figure));
  ASSERT_EQ(places.size(), 3u);
  EXPECT_NEAR(places[1].y - places[0].y, places[2].y - places[1].y, 0.11);
}

TEST(Svg, EverythingLiesInsideThePicture) {
  const SvgOptions options{.width = 500, .height = 300};
  for (const Place& p : circles(to_svg(points({-3, 1e6, 4}, {1e-9, -7, 1e9}), options))) {
    EXPECT_GE(p.x, 0);
    EXPECT_LE(p.x, options.width);
    EXPECT_GE(p.y, 0);
    EXPECT_LE(p.y, options.height);
  }
}

TEST(Svg, LeavesOutWhatHasNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(circles(to_svg(points({1, nan, 3}, {1, 2, nan}))).size(), 1u);
  Figure figure = points({1, 2}, {0, 5});
  figure.y.logarithmic = true;
  EXPECT_EQ(circles(to_svg(figure)).size(), 1u);
  EXPECT_EQ(to_svg(points({}, {})), "");
  EXPECT_EQ(to_svg(points({1}, {nan})), "");
}

TEST(Svg, NamesWithMarkupStayText) {
  Figure figure = points({1, 2}, {1, 2}, Mark::line);
  figure.series[0].name = "a<b>&\"c\"";
  figure.title = "<script>";
  const std::string svg = to_svg(figure);
  EXPECT_EQ(svg.find("<b>"), std::string::npos);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
  EXPECT_NE(svg.find("a&lt;b&gt;&amp;&quot;c&quot;"), std::string::npos);
}

TEST(Svg, SaysEachNameOnceInTheLegend) {
  Figure figure = points({1, 2}, {1, 2}, Mark::line);
  figure.series.push_back(figure.series[0]);
  const std::string svg = to_svg(figure);
  const std::regex legend(R"(text-anchor="start"[^>]*>s</text>)");
  EXPECT_EQ(std::distance(std::sregex_iterator(svg.begin(), svg.end(), legend), {}), 1);
}

TEST(Svg, NumbersThatDifferByRoundingAreOne) {
  for (const double value : {0.3, -7e5, 1e20}) {
    const double next = std::nextafter(value, 1e300);
    for (const bool logarithmic : {false, true}) {
      if (logarithmic && value < 0) continue;
      Figure figure = points({1, 2}, {value, next});
      figure.y.logarithmic = logarithmic;
      const std::string svg = to_svg(figure);
      EXPECT_LT(svg.size(), 5000u) << value;
      EXPECT_EQ(svg.find("nan"), std::string::npos) << value;
      const auto places = circles(svg);
      ASSERT_EQ(places.size(), 2u);
      EXPECT_NEAR(places[0].y, places[1].y, 0.11);
    }
  }
}

TEST(Svg, ADayLongAxisHasAFewRoundTicks) {
  Figure figure = points({0, 86400}, {0, 1});
  const std::string svg = to_svg(figure);
  EXPECT_NE(svg.find(">2e+04<"), std::string::npos);
  EXPECT_NE(svg.find(">8e+04<"), std::string::npos);
}

}  // namespace
}  // namespace fracbench
