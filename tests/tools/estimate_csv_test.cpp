#include "tools/evaluate/eval/estimate_csv.hpp"

#include <gtest/gtest.h>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

TEST(EstimateCsv, FindsColumnsByNameInAnyOrder) {
  const test::TempFolder folder;
  const auto planes = read_estimate_csv(folder.write(
      "e.csv", "roll_rad,seq,other,height_m,plane_status,pitch_rad\n0.1,5,x,1.6,held,-0.2\n"));
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_EQ(planes[0].seq, 5);
  EXPECT_EQ(planes[0].status, "held");
  EXPECT_DOUBLE_EQ(*planes[0].height_m, 1.6);
  EXPECT_DOUBLE_EQ(*planes[0].pitch_rad, -0.2);
  EXPECT_FALSE(planes[0].height_std_m);
}

TEST(EstimateCsv, TakesEmptyAndNanAsAbsent) {
  const test::TempFolder folder;
  const auto planes =
      read_estimate_csv(folder.write("e.csv", "seq,height_m,pitch_rad,roll_rad\n1,,nan,0\n"));
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_FALSE(planes[0].height_m);
  EXPECT_FALSE(planes[0].pitch_rad);
  EXPECT_TRUE(planes[0].roll_rad);
}

TEST(EstimateCsv, NamesWhatIsWrong) {
  const test::TempFolder folder;
  const auto error = [&](const std::string& text) {
    return input_error_of([&] { (void)read_estimate_csv(folder.write("e.csv", text)); });
  };
  expect_contains(error(""), "is empty");
  expect_contains(error("seq,height_m,roll_rad\n"), "column pitch_rad is missing");
  const std::string head = "seq,height_m,pitch_rad,roll_rad\n";
  expect_contains(error(head + "1,2,3\n"), "e.csv:2: 3 cells, the first line names 4");
  expect_contains(error(head + "1,tall,0,0\n"), "e.csv:2: height_m: 'tall' is not a number");
  expect_contains(error(head + ",2,0,0\n"), "seq is empty");
}

}  // namespace
}  // namespace plumb
