#include "metrics/registry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "source_folder.h"
#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;

// Cells that are as bad as they can be, beside good ones.
std::vector<Fragments> cells() {
  const std::vector<Vec3> normals{{1, 0.3, 0.2}, {-0.4, 1, 0.1}};
  Fragment not_finite = whole(box());
  not_finite.mesh.vertices[0].x() = std::numeric_limits<double>::infinity();
  Fragment out_of_range = whole(box());
  out_of_range.mesh.faces[0][0] = 1000;
  Fragment flat = whole(box({0, 0, 0}, {1, 1, 0}));
  Fragment point = whole(box(Vec3::Ones(), Vec3::Ones()));
  for (FragmentFace& face : flat.faces) face = {.interface = 0};
  for (FragmentFace& face : point.faces) face = {.interface = 1};
  return {cut_all(box(), Vec3::Constant(0.5), normals),
          corrugated_cube(3, 20),
          {whole(box())},
          {},
          {Fragment{}},
          {not_finite, out_of_range, flat, point}};
}

TEST(Registry, names_are_unique_and_described) {
  std::set<std::string> names;
  for (const auto& metric : metrics()) {
    EXPECT_TRUE(names.insert(metric->info().name).second) << metric->info().name;
    EXPECT_FALSE(metric->info().summary.empty());
  }
  EXPECT_GE(names.size(), 8u);
}

TEST(Registry, every_metric_and_value_has_its_place_in_the_documentation) {
  std::ifstream file(FRACBENCH_SOURCE_DIR "/docs/metrics.md");
  std::stringstream text;
  text << file.rdbuf();
  const std::vector<Impact> impacts{impact({0, 0, 1})};
  const std::vector<StageTime> stages{{"<name>", 1}};
  for (const auto& metric : metrics()) {
    EXPECT_NE(text.str().find("### " + metric->info().name + "\n"), std::string::npos)
        << metric->info().name;
    for (const Fragments& fragments : cells()) {
      const TriangleMesh body = box();
      const Measurement m = metric->measure({.body = body,
                                             .fragments = fragments,
                                             .impacts = impacts,
                                             .stages = stages,
                                             .total_seconds = 1,
                                             .peak_memory = 1});
      for (const MetricValue& v : m.values) {
        EXPECT_NE(text.str().find("`" + v.name + "`"), std::string::npos) << v.name;
      }
      for (const MetricSeries& s : m.series) {
        EXPECT_NE(text.str().find("`" + s.name + "`"), std::string::npos) << s.name;
      }
    }
  }
}

TEST(Registry, all_values_are_finite_and_named_once_whatever_the_fragments_are) {
  const std::vector<Impact> impacts{impact({0, 0, 1})};
  for (const Fragments& fragments : cells()) {
    std::set<std::string> names;
    for (const auto& metric : metrics()) {
      const TriangleMesh body = box();
      const Measurement m = metric->measure(cell(body, fragments, impacts));
      for (const MetricValue& v : m.values) {
        EXPECT_TRUE(std::isfinite(v.value)) << v.name;
        EXPECT_TRUE(names.insert(v.name).second) << v.name;
      }
      for (const MetricSeries& s : m.series) {
        EXPECT_TRUE(names.insert(s.name).second) << s.name;
        for (const double v : s.values) EXPECT_TRUE(std::isfinite(v)) << s.name;
      }
    }
  }
}

}  // namespace
}  // namespace fracbench
