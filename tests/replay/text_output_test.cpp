#include "tools/run/replay/text_output.hpp"

#include <gtest/gtest.h>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/replay/summary.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

TEST(TextOutput, WritesRows) {
  const test::TempFolder folder;
  TextOutput output(folder / "a.txt");
  output.row("one");
  output.row("two");
  output.close();
  EXPECT_EQ(test::read_text(folder / "a.txt"), "one\ntwo\n");
}

TEST(TextOutput, WithoutAPathTakesEverything) {
  TextOutput output("");
  output.row("one");
  output.close();
  EXPECT_FALSE(output.wanted());
}

TEST(TextOutput, SaysThatTheDiskIsFull) {
  const auto write = [] {
    TextOutput output("/dev/full");
    for (int i = 0; i < 1000; ++i) output.row(std::string(1000, 'x'));
    output.close();
  };
  expect_contains(input_error_of(write), "cannot write /dev/full");
  const auto write_little = [] {
    TextOutput output("/dev/full");
    output.row("x");
    output.close();
  };
  expect_contains(input_error_of(write_little), "cannot write /dev/full");
  expect_contains(input_error_of([] { TextOutput("/no/such/folder/a.txt"); }), "/no/such/folder");
}

TEST(Summary, CountsStatusesByName) {
  StatusCount count;
  vo_motion_t vo{};
  ground_plane_t plane{};
  ego_motion_t ego{};
  FrameRecord record;
  record.vo = &vo;
  record.plane = &plane;
  record.ego = &ego;
  count.add(record);
  plane.status = ground_plane_t::STATUS_HELD;
  count.add(record);
  FrameRecord refused;
  refused.refused = "why";
  count.add(refused);
  expect_contains(count.text(), "2 ok");
  expect_contains(count.text(), "1 held");
  expect_contains(count.text(), "refused 1");
}

}  // namespace
}  // namespace plumb
