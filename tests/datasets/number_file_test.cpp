#include "modules/datasets/number_file.hpp"

#include <gtest/gtest.h>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

TEST(NumberFile, TakesEveryWayToWriteANumberAndNothingElse) {
  EXPECT_DOUBLE_EQ(*parse_number("-1.5e-3"), -0.0015);
  EXPECT_DOUBLE_EQ(*parse_number("+2"), 2.0);
  for (const char* text : {"", "abc", "1.0x", "nan", "inf", "1e999", "0x10", "1,5"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(NumberFile, SplitsWordsAndCells) {
  EXPECT_EQ(split_words("  a \t b\r").size(), 2U);
  const auto cells = split_cells("a, ,b");
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_EQ(cells[1], "");
  EXPECT_EQ(cells[2], "b");
}

TEST(NumberFile, LeavesOutCommentsAndEmptyLinesButCountsThem) {
  const test::TempFolder folder;
  const auto rows = read_number_rows(folder.write("a.txt", "# head\n\n1 2\r\n3 4\n"), 2, 2);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].line, 3);
  EXPECT_DOUBLE_EQ(rows[1].values[1], 4.0);
}

TEST(NumberFile, LeavesOutAByteOrderMark) {
  const test::TempFolder folder;
  const auto lines = read_lines(folder.write("a.txt", "\xEF\xBB\xBFP0: 1\n\xEF\xBB\xBF\n"));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "P0: 1");
  EXPECT_EQ(lines[1].size(), 3U) << "it is one in the first line alone";
}

TEST(NumberFile, NamesFileLineAndWordOfWhatIsNotANumber) {
  const test::TempFolder folder;
  const auto path = folder.write("a.txt", "1 2\n3 nan\n");
  const std::string error = input_error_of([&] { (void)read_number_rows(path, 2, 2); });
  expect_contains(error, "a.txt:2: 'nan' is not a finite number");
}

TEST(NumberFile, RefusesRowsThatAreTooShortOrTooLong) {
  const test::TempFolder folder;
  const auto path = folder.write("a.txt", "1 2 3\n");
  expect_contains(input_error_of([&] { (void)read_number_rows(path, 4, 4); }),
                  "3 numbers, expected 4");
  expect_contains(input_error_of([&] { (void)read_number_rows(path, 1, 2); }), "3 numbers");
}

TEST(NumberFile, SaysWhichFileCannotBeRead) {
  const test::TempFolder folder;
  expect_contains(input_error_of([&] { (void)read_lines(folder / "none.txt"); }), "none.txt");
  EXPECT_NE(input_error_of([&] { (void)read_lines(folder.path()); }), "") << "a folder is no file";
}

}  // namespace
}  // namespace plumb
