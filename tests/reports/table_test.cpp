#include "reports/table.h"

#include <gtest/gtest.h>

#include <charconv>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "reports/csv.h"

namespace fracbench {
namespace {

TEST(Markdown, is_aligned_and_keeps_its_cells_apart) {
  const Table table{.name = "t",
                    .title = "T",
                    .columns = {{"name"}, {"Länge", "m"}, {"n"}},
                    .rows = {{std::string("a|b\nc"), 1.0 / 3, std::int64_t{12345678}},
                             {std::string("π"), Estimate{2, 1.5, 2.25}, {}}}};
  EXPECT_EQ(to_markdown(table),
            "| name   |     Länge [m] |        n |\n"
            "| :----- | ------------: | -------: |\n"
            "| a\\|b c |        0.3333 | 12345678 |\n"
            "| π      | 2 [1.5, 2.25] |          |\n");
}

TEST(Csv, follows_rfc_4180) {
  const Table table{.name = "t",
                    .title = "T",
                    .columns = {{"text"}, {"x", "m"}, {"y"}},
                    .rows = {{std::string("a,b"), 0.1, std::int64_t{-3}},
                             {std::string("say \"no\"\nplease"), {}, Estimate{1, 0.5, 2}}}};
  EXPECT_EQ(to_csv(table),
            "text,x [m],y,y low,y high\r\n"
            "\"a,b\",0.1,-3,,\r\n"
            "\"say \"\"no\"\"\nplease\",,1,0.5,2\r\n");
}

TEST(Csv, reads_back_to_the_same_bits_and_text) {
  Random random(1);
  Table table{.name = "t", .title = "T", .columns = {{"number"}, {"text"}}};
  const std::string letters = "ab\",\r\n |\t";
  for (int i = 0; i < 200; ++i) {
    std::string text;
    for (std::uint64_t k = random.below(8); k > 0; --k)
      text += letters[random.below(letters.size())];
    table.rows.push_back({std::exp(random.uniform(-200, 200)) * random.normal(), text});
  }
  table.rows.push_back({std::numeric_limits<double>::denorm_min(), std::string()});
  const auto lines = parse_csv(to_csv(table), "t");
  ASSERT_EQ(lines.size(), table.rows.size() + 1);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    ASSERT_EQ(lines[i + 1].size(), 2u);
    const std::string& text = lines[i + 1][0];
    double number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    EXPECT_EQ(number, std::get<double>(table.rows[i][0])) << text;
    EXPECT_EQ(lines[i + 1][1], std::get<std::string>(table.rows[i][1]));
  }
}

TEST(Csv, reads_files_with_bare_line_ends_and_refuses_an_open_quote) {
  const std::vector<std::vector<std::string>> expected{{"a", "", "b"}, {"", "c"}, {""}, {"d"}};
  EXPECT_EQ(parse_csv("a,,b\n,c\n\nd", "t"), expected);
  EXPECT_TRUE(parse_csv("", "t").empty());
  EXPECT_THROW(parse_csv("a,\"b\n", "t"), InputError);
}

TEST(ShortNumber, has_four_significant_digits) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(12), "12");
  EXPECT_EQ(short_number(3.14159265), "3.142");
  EXPECT_EQ(short_number(-1.25e-12), "-1.25e-12");
  EXPECT_EQ(short_number(123456), "1.235e+05");
}

}  // namespace
}  // namespace fracbench
