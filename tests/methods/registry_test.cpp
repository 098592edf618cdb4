#include "methods/registry.h"

#include <gtest/gtest.h>

#include <set>

#include "core/error.h"

namespace fracbench {
namespace {

TEST(MethodRegistry, FindsEveryMethodByItsName) {
  ASSERT_FALSE(methods().empty());
  for (const auto& method : methods()) {
    EXPECT_EQ(&find_method(method->info().name), method.get());
  }
}

TEST(MethodRegistry, NamesTheNearestMethodForAWrongName) {
  try {
    find_method("cdv");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'cvd'"), std::string::npos) << error.what();
  }
}

TEST(MethodRegistry, GivesEveryMethodADigestOfItsSourcesAndCompleteFacts) {
  std::set<std::string> digests;
  for (const auto& method : methods()) {
    const MethodInfo info = method->info();
    SCOPED_TRACE(info.name);
    EXPECT_EQ(info.source_digest.size(), 64u);
    EXPECT_TRUE(digests.insert(info.source_digest).second);
    EXPECT_FALSE(info.summary.empty());
    for (const Publication& publication : info.publications) {
      EXPECT_FALSE(publication.key.empty());
      EXPECT_FALSE(publication.authors.empty());
      EXPECT_FALSE(publication.title.empty());
    }
    EXPECT_FALSE(info.shape_type.empty());
    EXPECT_GT(info.volume_tolerance, 0);
  }
}

TEST(MethodRegistry, DescribesEveryOption) {
  for (const auto& method : methods()) {
    for (const OptionSpec& option : method->options()) {
      SCOPED_TRACE(method->info().name + "." + option.name);
      EXPECT_FALSE(option.summary.empty());
    }
    EXPECT_NO_THROW(Options(method->options(), {}, method->info().name));
  }
}

}  // namespace
}  // namespace fracbench
