#include "reports/items/representations.h"

#include <gtest/gtest.h>

#include <set>

#include "reports/sections.h"
#include "synthetic_cells.h"

namespace fracbench {
namespace {

using namespace synthetic;

/// Two diagrams of 8 x 8 pixels, halved, of which one does not come back.
ReportInput halves() {
  neural::RepresentationStudy study{.settings = {.side = 8, .patterns = 2, .epochs = 2},
                                    .true_regions = {2, 2}};
  for (const neural::Representation representation : neural::kRepresentations) {
    neural::StudyOutcome& outcome = study.outcomes.emplace_back();
    outcome.representation = representation;
    outcome.loss = {0.5, 0.25};
    outcome.agreement = {1, 0};
    outcome.ceiling = {1, 1};
    outcome.regions = {2, 1};
    for (int pixel = 0; pixel < 2 * 64; ++pixel) {
      outcome.targets.push_back(pixel % 8 < 4 ? 0.0f : 1.0f);
      outcome.decoded.push_back(pixel < 64 ? outcome.targets.back() : 0.5f);
      outcome.back.push_back(pixel < 64 && pixel % 8 >= 4 ? 1 : 0);
    }
  }
  return {.title = "halves", .study = study};
}

TEST(Representations, AreComparedByWhatComesBackOfThem) {
  const Table all = table(section(halves(), "representations"), "representations");
  ASSERT_EQ(all.rows.size(), 3u);
  EXPECT_EQ(at(all, 0, "representation"), TableCell(std::string("labels")));
  EXPECT_EQ(at(all, 0, "loss"), TableCell(std::string("Dice")));
  EXPECT_EQ(at(all, 1, "loss"), TableCell(std::string("L2")));
  EXPECT_EQ(at(all, 2, "last loss"), TableCell(0.25));
  const auto agreement = std::get<Estimate>(at(all, 2, "agreement"));
  EXPECT_EQ(agreement.value, 0.5);
  EXPECT_LE(agreement.low, 0.0);
  EXPECT_GE(agreement.high, 1.0);
  EXPECT_EQ(at(all, 2, "ceiling"), TableCell(1.0));
}

TEST(Representations, AreShownAsTheyWereLearned) {
  const ReportSection shown = section(halves(), "representations");
  ASSERT_EQ(shown.pictures.size(), 3u);
  const Picture& picture = shown.pictures[1].picture;
  const auto colours = [&](int row) {  // of the second diagram, in the middle of each half
    const int step = (picture.height + 4) / 3, y = row * step + step / 2;
    std::set<std::vector<std::uint8_t>> found;
    for (const int x : {step + step / 4, step + 3 * step / 4}) {
      const auto first = picture.rgb.begin() + 3 * (y * picture.width + x);
      found.insert({first, first + 3});
    }
    return found.size();
  };
  EXPECT_EQ(colours(0), 2u) << "what was to be learned";
  EXPECT_EQ(colours(1), 1u) << "what is decoded";
  EXPECT_EQ(colours(2), 1u) << "the one region";
}

TEST(Representations, AreAllThatIsToldOfAStudy) {
  std::set<std::string> names;
  for (const NamedSection& named : render_sections(halves())) names.insert(named.item.name);
  EXPECT_TRUE(names.contains("representations"));
  EXPECT_FALSE(names.contains("overview"));
  EXPECT_TRUE(section({}, "representations").empty());
}

}  // namespace
}  // namespace fracbench
