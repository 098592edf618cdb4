#include "core/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace fracbench {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const OptionsSchema kSchema = {
    {.name = "sites",
     .fallback = std::int64_t{20},
     .unit = "",
     .summary = "how many",
     .minimum = 2},
    {.name = "falloff",
     .fallback = 0.5,
     .unit = "m",
     .summary = "length",
     .minimum = 0,
     .maximum = 10},
    {.name = "mode",
     .fallback = std::string("fast"),
     .unit = "",
     .summary = "which",
     .choices = {"fast", "exact"}},
    {.name = "merge", .fallback = true, .unit = "", .summary = "whether"},
    {.name = "at", .fallback = std::vector<double>{}, .unit = "m", .summary = "places"},
};

std::string message_of(const OptionMap& given) {
  try {
    const Options options(kSchema, given, "quick.toml: method 'cvd'");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Options, FillsDefaultsAndKeepsWhatIsGiven) {
  const Options options(kSchema, {{"falloff", std::int64_t{2}}, {"mode", std::string("exact")}},
                        "x");
  EXPECT_EQ(options.integer("sites"), 20);
  EXPECT_EQ(options.number("falloff"), 2.0);
  EXPECT_EQ(options.text("mode"), "exact");
  EXPECT_TRUE(options.flag("merge"));
  EXPECT_TRUE(options.numbers("at").empty());
}

TEST(Options, NamesTheNearestOptionForAnUnknownOne) {
  EXPECT_THAT(
      message_of({{"site", std::int64_t{3}}}),
      AllOf(HasSubstr("quick.toml"), HasSubstr("'site'"), HasSubstr("did you mean 'sites'")));
  EXPECT_THAT(message_of({{"zzz", true}}), HasSubstr("known: sites, falloff"));
}

TEST(Options, NamesRangeAndUnitForAValueOutOfRange) {
  EXPECT_THAT(message_of({{"falloff", 11.5}}), AllOf(HasSubstr("11.5 m"), HasSubstr("0 to 10 m")));
  EXPECT_THAT(message_of({{"sites", std::int64_t{1}}}), HasSubstr("at least 2"));
  EXPECT_THAT(message_of({{"falloff", std::nan("")}}), HasSubstr("nan"));
}

TEST(Options, RejectsWrongTypesAndUnknownChoices) {
  EXPECT_THAT(message_of({{"sites", 2.5}}), HasSubstr("whole number"));
  EXPECT_THAT(message_of({{"merge", std::string("yes")}}), HasSubstr("true or false"));
  EXPECT_THAT(message_of({{"mode", std::string("fsat")}}), HasSubstr("'fsat'; known: fast, exact"));
}

TEST(Options, AreReadFromTextByTheTypeOfTheirDefault) {
  EXPECT_EQ(parse_option(kSchema, "sites", "7", "--set"), OptionValue(std::int64_t{7}));
  EXPECT_EQ(parse_option(kSchema, "falloff", "1e-1", "--set"), OptionValue(0.1));
  EXPECT_EQ(parse_option(kSchema, "merge", "false", "--set"), OptionValue(false));
  EXPECT_EQ(parse_option(kSchema, "at", "1,-2,3.5", "--set"),
            OptionValue(std::vector<double>{1, -2, 3.5}));
  EXPECT_THROW(parse_option(kSchema, "sites", "7x", "--set"), InputError);
  EXPECT_THROW(parse_option(kSchema, "sites", "", "--set"), InputError);
  EXPECT_THROW(parse_option(kSchema, "at", "1,,2", "--set"), InputError);
}

TEST(Options, AskingForWhatTheSchemaLacksIsAMistakeOfTheProgram) {
  const Options options(kSchema, {}, "x");
  EXPECT_THROW((void)options.integer("falloff"), std::logic_error);
  EXPECT_THROW((void)options.number("none"), std::logic_error);
}

}  // namespace
}  // namespace fracbench
