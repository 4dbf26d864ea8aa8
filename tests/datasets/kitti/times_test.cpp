#include "modules/datasets/kitti/times.hpp"

#include <gtest/gtest.h>

#include "modules/datasets/kitti/sequence.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

TEST(Times, OdometrySecondsBecomeMicrosecondsAboveZero) {
  const test::TempFolder folder;
  const auto times_us =
      read_odometry_times_us(folder.write("t.txt", "0.000000e+00\n1.041989e+01\n"));
  ASSERT_EQ(times_us.size(), 2U);
  EXPECT_GT(times_us[0], 0);
  EXPECT_EQ(times_us[0], kOdometryEpoch_us);
  EXPECT_EQ(times_us[1] - times_us[0], 10'419'890);
}

TEST(Times, RawTimeStampsAreUtc) {
  const test::TempFolder folder;
  const auto times_us = read_raw_times_us(
      folder.write("t.txt", "1970-01-02 00:00:00.000001499\n2011-09-26 13:02:25.964389445\n"));
  EXPECT_EQ(times_us[0], 86'400'000'001);
  EXPECT_EQ(times_us[1], 1'317'042'145'964'389);  // from: date -u -d '2011-09-26 13:02:25' +%s
}

TEST(Times, RefusesWhatIsNoTime) {
  const test::TempFolder folder;
  const auto raw = [&](const std::string& row) {
    return input_error_of([&] { (void)read_raw_times_us(folder.write("t.txt", row + "\n")); });
  };
  for (const char* row : {"yesterday", "2011-13-26 13:02:25.9", "2011-09-31 00:00:00.0",
                          "2011-09-26 25:02:25.9", "2011-09-26 13:02:25.9 x", "1.5"}) {
    expect_contains(raw(row), "t.txt:1: ");
  }
  expect_contains(
      input_error_of([&] { (void)read_odometry_times_us(folder.write("t.txt", "0\n-1\n")); }),
      "t.txt:2: time is outside");
  expect_contains(
      input_error_of([&] { (void)read_odometry_times_us(folder.write("t.txt", "a\n")); }),
      "'a' is not a finite number");
}

}  // namespace
}  // namespace plumb
