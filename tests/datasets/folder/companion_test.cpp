#include "modules/datasets/folder/companion.hpp"

#include <gtest/gtest.h>

#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

TEST(Companion, IsLookedForInTheFolderAndThenAboveIt) {
  const test::TempFolder folder;
  folder.write("drive/images/1.jpg", "");
  const auto above = folder.write("drive/calib.txt", "");
  EXPECT_EQ(find_companion(folder / "drive/images", {"camera.toml", "calib.txt"}), above);
  const auto inside = folder.write("drive/images/calib.txt", "");
  for (const char* images : {"drive/images", "drive/images/", "drive/images/.", "drive/./images"})
    EXPECT_EQ(find_companion(folder / images, {"camera.toml", "calib.txt"}), inside) << images;
  const auto preferred = folder.write("drive/images/camera.toml", "");
  EXPECT_EQ(find_companion(folder / "drive/images", {"camera.toml", "calib.txt"}), preferred);
}

TEST(Companion, OfAFileLiesBesideIt) {
  const test::TempFolder folder;
  const auto video = folder.write("videos/a.mp4", "");
  EXPECT_EQ(find_companion(video, {"camera.toml"}), "");
  const auto above = folder.write("camera.toml", "");
  EXPECT_EQ(find_companion(video, {"camera.toml"}), above);
  const auto beside = folder.write("videos/camera.toml", "");
  EXPECT_EQ(find_companion(video, {"camera.toml"}), beside);
}

}  // namespace
}  // namespace plumb
