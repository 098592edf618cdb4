#include "metrics/validity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "synthetic.h"

namespace fracbench {
namespace {

using namespace synthetic;
using ::testing::HasSubstr;

const std::vector<Vec3> normals{{1, 0.3, 0.2}, {-0.4, 1, 0.1}, {0, 0.2, 1}};

Fragments eight() { return cut_all(box(), {0.4, 0.5, 0.55}, normals); }

Measurement measured(const Fragments& fragments) {
  return Validity().measure(cell(box(), fragments));
}

// The names of the conditions that do not hold.
std::vector<std::string> failed(const Measurement& m) {
  std::vector<std::string> result;
  for (const char* name :
       {"closed", "oriented", "manifold", "self_intersection_free", "disjoint"}) {
    if (value(m, name) == 0) result.emplace_back(name);
  }
  EXPECT_EQ(value(m, "valid") == 1,
            result.empty() || result == std::vector<std::string>{"manifold"});
  return result;
}

using Names = std::vector<std::string>;

TEST(Validity, of_clean_cuts_is_given_and_the_volume_is_kept) {
  const Measurement m = measured(eight());
  EXPECT_EQ(failed(m), Names{});
  EXPECT_NEAR(value(m, "volume_ratio"), 1, 1e-14);
  EXPECT_EQ(value(m, "invalid_fragments"), 0);
  EXPECT_EQ(series(m, "fragment_valid"), std::vector<double>(8, 1));
  EXPECT_EQ(check_fragments(box(), eight()).describe(), "valid");
}

TEST(Validity, says_which_fragment_is_open) {
  Fragments fragments = eight();
  fragments[3].mesh.faces.pop_back();
  fragments[3].faces.pop_back();
  const Measurement m = measured(fragments);
  EXPECT_THAT(failed(m), ::testing::Contains("closed"));
  EXPECT_EQ(value(m, "self_intersection_free"), 1);
  EXPECT_EQ(value(m, "disjoint"), 1);
  EXPECT_EQ(series(m, "fragment_valid"), (std::vector<double>{1, 1, 1, 0, 1, 1, 1, 1}));
  EXPECT_THAT(check_fragments(box(), fragments).describe(), HasSubstr("1 fragment not closed: 3"));
}

TEST(Validity, says_which_fragment_is_inside_out) {
  Fragments fragments = eight();
  for (Face& face : fragments[5].mesh.faces) std::swap(face[0], face[1]);
  const Measurement m = measured(fragments);
  EXPECT_EQ(failed(m), Names{"oriented"});
  EXPECT_EQ(series(m, "fragment_valid").at(5), 0);
  EXPECT_LT(value(m, "volume_ratio"), 1);
  EXPECT_THAT(check_fragments(box(), fragments).describe(),
              HasSubstr("1 fragment not oriented outwards: 5"));
}

TEST(Validity, says_which_fragment_has_one_face_turned) {
  Fragments fragments = eight();
  std::swap(fragments[2].mesh.faces[4][0], fragments[2].mesh.faces[4][1]);
  EXPECT_THAT(failed(measured(fragments)), ::testing::Contains("oriented"));
  EXPECT_EQ(series(measured(fragments), "fragment_valid").at(2), 0);
}

TEST(Validity, says_which_fragments_overlap) {
  Fragments fragments = eight();
  for (Vec3& v : fragments[6].mesh.vertices) v += Vec3(0, 0, -1e-3);
  const Measurement m = measured(fragments);
  EXPECT_EQ(failed(m), Names{"disjoint"});
  // Each fragment is a solid, and the volume says nothing.
  EXPECT_EQ(value(m, "invalid_fragments"), 0);
  EXPECT_NEAR(value(m, "volume_ratio"), 1, 1e-12);
  EXPECT_THAT(check_fragments(box(), fragments).describe(), HasSubstr("and 6 overlap"));
}

TEST(Validity, says_which_fragment_intersects_itself) {
  // Two boxes in one mesh, through each other.
  Fragment crossed = whole(box({0, 0.4, 0.4}, {1, 0.6, 0.6}));
  const Fragment other = whole(box({0.4, 0, 0.45}, {0.6, 1, 0.55}));
  for (const Face& face : other.mesh.faces) {
    crossed.mesh.faces.push_back({face[0] + 8, face[1] + 8, face[2] + 8});
    crossed.faces.push_back({});
  }
  crossed.mesh.vertices.insert(crossed.mesh.vertices.end(), other.mesh.vertices.begin(),
                               other.mesh.vertices.end());
  const Measurement m = measured({whole(box({5, 5, 5}, {6, 6, 6})), crossed});
  EXPECT_THAT(failed(m), ::testing::Contains("self_intersection_free"));
  EXPECT_EQ(series(m, "fragment_valid"), (std::vector<double>{1, 0}));
}

TEST(Validity, of_what_is_no_mesh_fails_without_a_crash) {
  Fragments fragments = eight();
  fragments[0].mesh.vertices[2].y() = std::numeric_limits<double>::quiet_NaN();
  fragments[1].mesh.faces[0][0] = -4;
  fragments[2].mesh.faces[0][0] = 4000;
  fragments[4].faces.pop_back();
  fragments.emplace_back();
  const Measurement m = measured(fragments);
  EXPECT_EQ(series(m, "fragment_valid"), (std::vector<double>{0, 0, 0, 1, 0, 1, 1, 1, 0}));
  EXPECT_EQ(value(m, "valid"), 0);
  EXPECT_THAT(check_fragments(box(), fragments).describe(), HasSubstr("0, 1, 2, 4, 8"));
}

TEST(Validity, of_nothing_fails) {
  const Measurement m = measured({});
  EXPECT_EQ(value(m, "valid"), 0);
  EXPECT_EQ(value(m, "volume_ratio"), 0);
}

TEST(Validity, volume_that_is_lost_or_doubled_shows_in_the_ratio) {
  Fragments fragments = eight();
  fragments.push_back(whole(box({3, 3, 3}, {3.5, 4, 4})));
  EXPECT_NEAR(value(measured(fragments), "volume_ratio"), 1.5, 1e-14);
  EXPECT_EQ(value(measured(fragments), "valid"), 1);  // the ratio is the caller's to judge
}

TEST(Validity, is_the_same_for_any_number_of_threads) {
  Fragments fragments = eight();
  for (Vec3& v : fragments[6].mesh.vertices) v += Vec3(0.01, 0, -1e-3);
  const ValidityReport one = check_fragments(box(), fragments, 1);
  const ValidityReport two = check_fragments(box(), fragments, 2);
  EXPECT_EQ(one.describe(), two.describe());
  EXPECT_EQ(one.volume_ratio, two.volume_ratio);
}

}  // namespace
}  // namespace fracbench
