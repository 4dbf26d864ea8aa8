#include "modules/datasets/kitti/image_list.hpp"

#include <gtest/gtest.h>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

std::vector<NumberedImage> numbered(std::initializer_list<std::int64_t> numbers) {
  std::vector<NumberedImage> images;
  for (const std::int64_t number : numbers) images.push_back({number, {}});
  return images;
}

TEST(ImageList, SortsByNumberAndPassesOverOtherFiles) {
  const test::TempFolder folder;
  for (const char* name : {"000010.png", "000009.png", "notes.txt", "mask.png", "000011.jpg"}) {
    folder.write(name, "");
  }
  const auto images = list_images(folder.path());
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(images[0].number, 9);
  EXPECT_EQ(images[1].path.filename(), "000010.png");
}

TEST(ImageList, RefusesAnEmptyAMissingAndADoubleOne) {
  const test::TempFolder folder;
  expect_contains(input_error_of([&] { (void)list_images(folder.path()); }), "has no image");
  expect_contains(input_error_of([&] { (void)list_images(folder / "none"); }), "no image folder");
  folder.write("000007.png", "");
  folder.write("0000000007.png", "");
  expect_contains(input_error_of([&] { (void)list_images(folder.path()); }),
                  "frame 7 is there twice");
}

TEST(ImageList, TellsEveryGapButNotForever) {
  EXPECT_TRUE(describe_gaps(numbered({4, 5, 6})).empty());
  const auto notes = describe_gaps(numbered({4, 5, 7, 11}));
  ASSERT_EQ(notes.size(), 2U);
  expect_contains(notes[0], "1 frame is missing after 5");
  expect_contains(notes[1], "3 frames are missing after 7");
  EXPECT_EQ(describe_gaps(numbered({0, 2, 4, 6, 8, 10, 12, 14, 16})).size(), 6U);
}

TEST(RowLookup, TakesRowsFromTheFirstImageOn) {
  const auto images = numbered({100, 101, 103});
  const RowLookup lookup("times.txt", 4, images);
  EXPECT_EQ(lookup.row(0, 100), 0U);
  EXPECT_EQ(lookup.row(2, 103), 3U);
}

TEST(RowLookup, TakesRowsOfTheWholeSequence) {
  const auto images = numbered({100, 101, 103});
  EXPECT_EQ(RowLookup("times.txt", 2761, images).row(2, 103), 103U);
  EXPECT_EQ(RowLookup("times.txt", 104, images).row(0, 100), 100U);
}

TEST(RowLookup, TakesOneRowPerImageWhenSomeAreMissing) {
  EXPECT_EQ(RowLookup("times.txt", 3, numbered({100, 101, 103})).row(2, 103), 2U);
}

TEST(RowLookup, RefusesANumberOfRowsThatFitsNothing) {
  const auto error = input_error_of([] { RowLookup("times.txt", 5, numbered({100, 101, 103})); });
  expect_contains(error, "times.txt has 5 rows for 3 images numbered 100 to 103");
}

}  // namespace
}  // namespace plumb
