#include "methods/bem/validation/crack_cases.h"

#include <gtest/gtest.h>

#include <set>

#include "core/progress.h"

namespace fracbench::bem {
namespace {

class CrackCases : public testing::TestWithParam<std::size_t> {};

TEST_P(CrackCases, AgreeWithWhatIsKnown) {
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress, .threads = 2};
  const ValidationCase validation = crack_validation_cases()[GetParam()];
  for (const Accuracy& row : validation.run(context)) {
    EXPECT_TRUE(row.pass()) << row.name << ": " << row.computed << " for " << row.expected
                            << " (error " << row.error() << ", allowed " << row.tolerance << ")";
    if (row.pass()) {
      RecordProperty(row.name, std::to_string(row.error()));
    }
  }
}

std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  std::string name = crack_validation_cases()[info.param].name;
  std::erase_if(name, [](char c) { return c == '-' || c == '.'; });
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, CrackCases,
                         testing::Range<std::size_t>(0, crack_validation_cases().size()), name_of);

TEST(CrackValidationCases, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const ValidationCase& validation : crack_validation_cases()) {
    EXPECT_TRUE(names.insert(validation.name).second);
  }
}

}  // namespace
}  // namespace fracbench::bem
