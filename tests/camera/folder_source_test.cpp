#include "modules/camera/folder_source.hpp"

#include <gtest/gtest.h>

#include "modules/datasets/kitti/sequence.hpp"
#include "platform/process.hpp"
#include "tests/camera/pattern.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_folder.hpp"

namespace plumb {
namespace {

using test::test_image;

// The tests of the datasets cover names, times and formats. These cover what a source does with
// them.

TEST(FolderSource, DeliversEveryPixelTimeAndNumber) {
  const test::TempFolder folder;
  for (const int i : {9, 10, 12})
    test::write_image(folder, format("images/frame_%d.png", i), test_image(i));
  FolderSource source({folder / "images", 20.0, {}});
  EXPECT_EQ(source.num_frames(), 3);
  EXPECT_EQ(source.notes(), std::vector<std::string>{"1 image is missing before frame_12.png"});
  GreyFrame frame;
  for (const int i : {9, 10, 12}) {
    ASSERT_TRUE(source.read(&frame));
    EXPECT_EQ(frame.seq, i);
    EXPECT_EQ(frame.capture_us, kOdometryEpoch_us + 50'000 * (i - 9));
    test::expect_pixels(frame.image, test_image(i));
  }
  EXPECT_FALSE(source.read(&frame));
  EXPECT_FALSE(source.read(&frame));
}

TEST(FolderSource, KeepsTimesSince1970) {
  const test::TempFolder folder;
  test::write_image(folder, "1532402927612460.png", test_image(1));
  FolderSource source({folder.path(), 0.0, {}});
  GreyFrame frame;
  ASSERT_TRUE(source.read(&frame));
  EXPECT_EQ(frame.capture_us, 1'532'402'927'612'460);
}

TEST(FolderSource, TellsTheSizeAndRefusesAnother) {
  const test::TempFolder folder;
  test::write_image(folder, "1.png", test_image(1, 96, 72));
  const FolderSource source({folder.path(), 10.0, {}});
  CameraConfig config;
  source.complete(&config);
  EXPECT_EQ(config.width_px, 96);
  EXPECT_EQ(config.height_px, 72);
  config.width_px = 640;
  EXPECT_EQ(
      test::input_error_of([&] { source.complete(&config); }),
      (folder / "1.png").string() + " is 96x72, camera.width_px and camera.height_px say 640x72");
}

TEST(FolderSource, RefusesAnImageOfAnotherSizeAndADamagedOneByItsName) {
  const test::TempFolder folder;
  test::write_image(folder, "1.png", test_image(1, 96, 72));
  test::write_image(folder, "2.png", test_image(2, 95, 72));
  FolderSource source({folder.path(), 10.0, {}});
  GreyFrame frame;
  ASSERT_TRUE(source.read(&frame));
  EXPECT_EQ(test::input_error_of([&] { (void)source.read(&frame); }),
            (folder / "2.png").string() + " is 95x72, the images before it are 96x72");
  folder.write("1.png", "no image");
  test::expect_contains(test::input_error_of([&] {
                          FolderSource(ImageFolderOptions{folder.path(), 10.0, {}});
                        }),
                        "1.png is not an image that can be read");
}

}  // namespace
}  // namespace plumb
