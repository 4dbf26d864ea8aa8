#include "modules/camera/image_health.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/camera/pattern.hpp"
#include "tests/support/kitti_data.hpp"

namespace plumb {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 90;

class ImageHealthTest : public testing::Test {
 protected:
  ImageFault show(const cv::Mat& image) { return health_.update(test::view_of(image)); }
  ImageFault show(double mean, double spread, unsigned seed) {
    cv::Mat image(kHeight, kWidth, CV_8U);
    cv::theRNG().state = seed;
    cv::randn(image, mean, spread);
    return show(image);
  }
  ImageHealth health_{kWidth, kHeight, ImageHealthLimits{}};
};

TEST_F(ImageHealthTest, LivelyImagesAreHealthy) {
  for (unsigned i = 1; i < 20; ++i)
    EXPECT_EQ(show(test::noise(kHeight, kWidth, i)), ImageFault::kNone);
  EXPECT_NEAR(health_.mean(), 127.5, 3.0);
  EXPECT_NEAR(health_.std_dev(), 73.9, 3.0);
}

TEST_F(ImageHealthTest, BlackIsRaisedByTheThirdImageAndNotBefore) {
  EXPECT_EQ(show(16.0, 1.0, 1), ImageFault::kNone);
  EXPECT_EQ(show(16.0, 1.0, 2), ImageFault::kNone);
  EXPECT_EQ(show(16.0, 1.0, 3), ImageFault::kBlack);
  EXPECT_STREQ(describe(health_.fault()), "the image is black");
}

TEST_F(ImageHealthTest, AnUnchangingBlackImageIsCalledBlackNotFrozen) {
  const cv::Mat black(kHeight, kWidth, CV_8U, cv::Scalar(0));
  for (int i = 0; i < 6; ++i) (void)show(black);
  EXPECT_EQ(health_.fault(), ImageFault::kBlack);
}

TEST_F(ImageHealthTest, ABrightImageWithoutStructureIsFlat) {
  for (unsigned i = 1; i < 5; ++i) (void)show(250.0, 1.5, i);
  EXPECT_EQ(health_.fault(), ImageFault::kFlat);
}

TEST_F(ImageHealthTest, ANightRoadUnderHeadLampsIsNotBlack) {
  cv::Mat night(kHeight, kWidth, CV_8U);
  for (unsigned i = 1; i < 8; ++i) {
    cv::theRNG().state = i;
    cv::randn(night, 9.0, 2.0);
    night(cv::Rect(50, 60, 60, 20)) += cv::Scalar(60);
    EXPECT_EQ(show(night), ImageFault::kNone);
  }
}

TEST_F(ImageHealthTest, TheSameImageAgainAndAgainIsFrozen) {
  const cv::Mat image = test::noise(kHeight, kWidth, 9);
  EXPECT_EQ(show(image), ImageFault::kNone);  // the first one differs from the previous image
  EXPECT_EQ(show(image), ImageFault::kNone);
  EXPECT_EQ(show(image), ImageFault::kNone);
  EXPECT_EQ(show(image), ImageFault::kFrozen);
}

TEST_F(ImageHealthTest, OneRepeatedFrameIsNotFrozen) {
  for (unsigned i = 1; i < 12; ++i) {
    const cv::Mat image = test::noise(kHeight, kWidth, i);
    EXPECT_EQ(show(image), ImageFault::kNone);
    EXPECT_EQ(show(image), ImageFault::kNone);
  }
}

TEST_F(ImageHealthTest, OnePixelInTheLastCornerIsEnoughToBeAlive) {
  cv::Mat image = test::noise(kHeight, kWidth, 10);
  for (int i = 0; i < 10; ++i) {
    image.at<std::uint8_t>(kHeight - 1, kWidth - 1) ^= 1U;
    EXPECT_EQ(show(image), ImageFault::kNone);
  }
}

TEST_F(ImageHealthTest, AFaultIsClearedByTheThirdHealthyImageAndNotBefore) {
  const cv::Mat frozen = test::noise(kHeight, kWidth, 11);
  for (int i = 0; i < 5; ++i) (void)show(frozen);
  EXPECT_EQ(show(test::noise(kHeight, kWidth, 12)), ImageFault::kFrozen);
  EXPECT_EQ(show(test::noise(kHeight, kWidth, 13)), ImageFault::kFrozen);
  EXPECT_EQ(show(test::noise(kHeight, kWidth, 14)), ImageFault::kNone);
}

TEST(ImageHealthOnRealRoads, NoFaultIsRaised) {
  const auto folder = test::kitti_sequence("odometry/sequences/04_000-050");
  if (folder.empty()) GTEST_SKIP() << test::kNoKitti;
  std::vector<cv::String> files;
  cv::glob((folder / "image_0" / "*.png").string(), files);
  ASSERT_FALSE(files.empty());
  const cv::Mat first = cv::imread(files.front(), cv::IMREAD_UNCHANGED);
  ImageHealth health(first.cols, first.rows, ImageHealthLimits{});
  for (const auto& file : files) {
    const cv::Mat image = cv::imread(file, cv::IMREAD_UNCHANGED);
    EXPECT_EQ(health.update(test::view_of(image)), ImageFault::kNone) << file;
  }
}

}  // namespace
}  // namespace plumb
