#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "tests/integrity/picture_drive.hpp"
#include "tests/support/kitti_data.hpp"

namespace plumb {
namespace {

using test::changed;
using test::Pictures;
using test::verdicts;

class PictureKitti : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const auto folder = test::kitti_sequence(GetParam());
    if (folder.empty()) GTEST_SKIP() << test::kNoKitti;
    std::vector<std::filesystem::path> files;
    for (const auto& file : std::filesystem::directory_iterator(folder / "image_0"))
      files.push_back(file.path());
    std::sort(files.begin(), files.end());
    files.resize(std::min<std::size_t>(files.size(), 50));
    for (const auto& file : files) drive_.push_back(cv::imread(file, cv::IMREAD_GRAYSCALE));
  }
  Pictures drive_;
};

TEST_P(PictureKitti, ARealDriveIsFreshAlsoCompressedAndNoisy) {
  const std::string fresh(drive_.size(), '.');
  EXPECT_EQ(verdicts(drive_), fresh);
  EXPECT_EQ(verdicts(changed(drive_, [](auto& p, auto i) { return test::with_jpeg(p[i], 40); })),
            fresh);
  EXPECT_EQ(verdicts(changed(
                drive_,
                [](auto& p, auto i) { return test::with_noise(p[i], 3.0, static_cast<int>(i)); })),
            fresh);
}

TEST_P(PictureKitti, RepetitionsAreFoundAndNothingElse) {
  const auto is_repeat = [](std::size_t i) { return i % 7 == 6; };
  const std::string letters = verdicts(changed(drive_, [&](const Pictures& p, std::size_t i) {
    return is_repeat(i) ? test::with_noise(p[i - 1], 2.0, static_cast<int>(i)) : p[i];
  }));
  for (std::size_t i = 0; i < letters.size(); ++i)
    EXPECT_EQ(letters[i], is_repeat(i) ? 'R' : '.') << i;
}

TEST_P(PictureKitti, AFrozenLowerHalfAndAFlipAreFoundAtOnce) {
  const std::string half = verdicts(changed(drive_, [](const Pictures& p, std::size_t i) {
    return i > 20 ? test::with_rows(p[i], p[20], 0.5, 1.0) : p[i];
  }));
  EXPECT_EQ(half, std::string(21, '.') + "T" + std::string(half.size() - 22, 'P'));
  const std::string flipped = verdicts(changed(drive_, [](const Pictures& p, std::size_t i) {
    cv::Mat image = p[i];
    if (i >= 20) cv::flip(p[i], image, -1);
    return image;
  }));
  EXPECT_EQ(flipped, std::string(20, '.') + std::string(flipped.size() - 20, 'U'));
}

INSTANTIATE_TEST_SUITE_P(Drives, PictureKitti,
                         testing::Values("odometry/sequences/04_000-050",
                                         "odometry/sequences/07_000-159", "raw/drive0009_000-050"));

}  // namespace
}  // namespace plumb
