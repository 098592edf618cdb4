#include "methods/bem/validation/elastic_cases.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/methods/bem/plain_context.h"

namespace fracbench::bem {
namespace {

class ElasticCases : public testing::TestWithParam<std::size_t> {};

TEST_P(ElasticCases, KeepToTheirTolerances) {
  PlainContext context;
  const ValidationCase validation = elastic_validation_cases()[GetParam()];
  const std::vector<Accuracy> rows = validation.run(context.get());
  EXPECT_FALSE(rows.empty());
  for (const Accuracy& row : rows) {
    EXPECT_TRUE(row.pass()) << row.name << ": computed " << row.computed << ", expected "
                            << row.expected << ", error " << row.error() << " above "
                            << row.tolerance;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ElasticCases,
                         testing::Range<std::size_t>(0, elastic_validation_cases().size()),
                         [](const auto& instance) {
                           std::string name = elastic_validation_cases()[instance.param].name;
                           std::erase(name, '-');
                           return name;
                         });

TEST(ElasticCaseNames, AreTheirOwn) {
  std::set<std::string> names;
  for (const ValidationCase& validation : elastic_validation_cases()) {
    EXPECT_TRUE(names.insert(validation.name).second) << validation.name;
  }
}

}  // namespace
}  // namespace fracbench::bem
