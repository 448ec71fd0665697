#include "bench/compare/text_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnbv {
namespace {

using enum ColumnKind;

TextTable example() {
  return {.title = "T & co",
          .columns = {{"Name", "name", text},
                      {"Runs", "runs", number},
                      {"Coverage", "coverage", estimate},
                      {"Metres", "metres", counted}},
          .rows = {{{"a, \"b\""},
                    {"5", {5.0, std::nullopt}},
                    {"92.8 ±0.6%", {0.9279255027467871, 0.006}},
                    {"-2.1 (4 of 5)", {-2.1, 4.0}}},
                   {{"éé"}, {"-"}, {"50.0%†", {0.5, std::nullopt}}, {"-"}}},
          .notes = {"one, two"}};
}

std::size_t code_points(std::string_view line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

TEST(TextTable, TerminalColumnsEndOrBeginBelowEachOther) {
  std::istringstream lines(terminal_text(example()));
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) all.push_back(line);
  ASSERT_EQ(all.size(), 6U);  // title, head, rule, two rows and a note
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(code_points(all[i]), code_points(all[1])) << all[i];
  EXPECT_TRUE(all[3].starts_with("a, \"b\" ") && all[3].ends_with("-2.1 (4 of 5)")) << all[3];
  EXPECT_TRUE(all[4].starts_with("éé ") && all[4].ends_with(" -")) << all[4];
}

/// As `gnbv compare` prints it: many rows of three names, some columns that say one thing.
TextTable wide_table() {
  TextTable table;
  table.columns = {{"Scenario", "scenario", text},   {"Metric", "metric", text},
                   {"Method", "method", text},       {"n", "n", counted},
                   {"Mean", "mean", estimate},       {"Rank", "rank", number},
                   {"Difference", "diff", estimate}, {"p", "p", number},
                   {"Holm", "holm", number},         {"Verdict", "verdict", text}};
  for (int metric = 0; metric < 20; ++metric) {
    for (const std::string method : {"proposed", "bircher", "tour"}) {
      const std::string figure = std::to_string(100 * metric) + (method == "tour" ? ".1" : ".2");
      table.rows.push_back({{"aircraft"},
                            {"share of the ceiling at metric " + std::to_string(metric)},
                            {method},
                            {"8"},
                            {figure + " ±123.4"},
                            {"-"},
                            {"-" + figure + " ±234.5"},
                            {"0.0" + figure},
                            {"0.0" + figure},
                            {metric % 2 == 0 ? "not significant" : "better, by interval only"}});
    }
  }
  table.notes = {"what the columns are"};
  return table;
}

std::size_t count_of(std::string_view what, std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

TEST(TextTable, WideTablesAreNarrowedByNoMoreThanItTakesAndLoseNoCell) {
  const TextTable table = wide_table();
  EXPECT_EQ(count_of("aircraft", terminal_text(table, 300)), 60U);  // a name a row
  for (const std::size_t width : {80, 60, 50}) {
    const std::string narrow = terminal_text(table, width);
    std::istringstream lines(narrow);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(code_points(line), width) << line;
    const std::size_t blocks = count_of("\n-----", "\n" + narrow);
    EXPECT_EQ(blocks == 1, width == 80) << narrow;
    EXPECT_EQ(count_of("\naircraft, share of the ceiling at metric 7\n", narrow), blocks);
    EXPECT_EQ(count_of("\ntour", narrow), 20 * blocks);
    for (const auto& row : table.rows) {
      for (const std::size_t column : {4, 6, 7}) {
        EXPECT_GE(count_of(row[column].text, narrow), 1U) << row[column].text;
      }
    }
  }
}

TEST(TextTable, MarkdownHasOneCellAColumnAndNoMarkupOfItsText) {
  TextTable table;
  table.columns = {{"a", "a", text}, {"b|c", "b", number}};
  table.rows = {{{"x_y_ *<z>`"}, {"1"}}, {{"line\nfeed"}, {"22"}}};
  const std::string markdown = markdown_text(table);
  EXPECT_EQ(count_of("| b\\|c |", markdown), 1U) << markdown;
  EXPECT_EQ(count_of("| x_y\\_ \\*\\<z>\\` |", markdown), 1U) << markdown;
  EXPECT_EQ(count_of("| line feed ", markdown), 1U) << markdown;
}

/// RFC 4180; numbers are the shortest that read back as the same.
TEST(TextTable, CsvHasPlainNumbersAndQuotesWhatNeedsIt) {
  EXPECT_EQ(csv_text(example()),
            "name,runs,coverage,coverage_ci95,metres,metres_runs\r\n"
            "\"a, \"\"b\"\"\",5,0.9279255027467871,0.006,-2.1,4\r\n"
            "éé,,0.5,,,\r\n"
            "\"note: one, two\",,,,,\r\n");
}

TEST(TextTable, JsonReadsBackWithTheSameNumbers) {
  const auto json = nlohmann::json::parse(json_text(example()));
  EXPECT_EQ(json.at("title"), "T & co");
  EXPECT_EQ(json.at("notes").at(0), "one, two");
  EXPECT_EQ(json.at("columns").size(), 6U);
  EXPECT_EQ(json.at("rows").at(0).at("name"), "a, \"b\"");
  EXPECT_EQ(json.at("rows").at(0).at("coverage"), 0.9279255027467871);
  EXPECT_EQ(json.at("rows").at(0).at("coverage_ci95"), 0.006);
  EXPECT_TRUE(json.at("rows").at(1).at("metres").is_null());
}

TEST(TextTable, LatexEscapesAllThatItWouldRead) {
  TextTable table = example();
  table.rows = {{{"\\&%_#${}~^--x<y>|"}, {"1"}, {"92.8 ±0.6%†"}, {"-"}}};
  const std::string latex = latex_text(table);
  for (const char* escaped :
       {"\\caption{T \\& co}", "\n\\textbackslash{}\\&\\%\\_\\#\\$\\{\\}\\textasciitilde{}",
        "\\textasciicircum{}-{}-x\\textless{}y\\textgreater{}\\textbar{} & 1 & ",
        "92.8 $\\pm$0.6\\%$^\\dagger$ & - \\\\\n"}) {
    EXPECT_EQ(count_of(escaped, latex), 1U) << escaped << " in " << latex;
  }
}

TEST(TextTable, ColumnsOfAnotherTableGoToTheRowsOfTheSameName) {
  const TextTable more = {.title = "",
                          .columns = {{"Name", "name", text}, {"More", "more", number}},
                          .rows = {{{"éé"}, {"7", {7.0, std::nullopt}}}, {{"zz"}, {"8"}}},
                          .notes = {"three"}};
  const TextTable both = with_columns_of(example(), more, 1);
  EXPECT_EQ(both.columns.back().key, "more");
  EXPECT_EQ(both.rows[0].back().text, "-");
  EXPECT_EQ(both.rows[1].back().text, "7");
  EXPECT_EQ(both.rows.size(), 2U);
  EXPECT_EQ(both.notes, (std::vector<std::string>{"one, two", "three"}));
  for (const auto& row : both.rows) EXPECT_EQ(row.size(), both.columns.size());
}

TEST(TextTable, EveryFormCarriesEveryNote) {
  for (const std::string_view format : kTableFormats) {
    EXPECT_NE(formatted_text(example(), format).find("one, two"), std::string::npos) << format;
  }
}

}  // namespace
}  // namespace gnbv
