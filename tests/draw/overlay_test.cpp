/// Tests how objects are drawn onto frames: where their edges lie, and what is left out.
#include "tools/run/draw/overlay.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tools/run/draw/labels.hpp"

namespace plumb {
namespace {

constexpr int kWidth_px = 1242, kHeight_px = 375;

CameraModel kitti_camera() {
  return {kWidth_px, kHeight_px, 721.5, 721.5, 609.6, 172.9, 0.0256, -0.0076, 1.65};
}

/// Returns a mask that is 255 where drawing the object changes the picture.
cv::Mat drawn(const ObjectFigure& object) {
  FrameFigures figures;
  figures.plane = PlaneFigure{Eigen::Vector3d::UnitY(), 1.65};
  const cv::Mat grey(kHeight_px, kWidth_px, CV_8U, cv::Scalar(128));
  const cv::Mat without = draw_overlay(grey, kitti_camera(), figures);
  figures.objects = {object};
  const cv::Mat with = draw_overlay(grey, kitti_camera(), figures);
  cv::Mat changed(kHeight_px, kWidth_px, CV_8U, cv::Scalar(0));
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      if (with.at<cv::Vec3b>(v, u) != without.at<cv::Vec3b>(v, u))
        changed.at<std::uint8_t>(v, u) = 255;
    }
  }
  return changed;
}

TEST(Overlay, DrawsTheBoxWhereTheObjectStands) {
  // Lines are two pixels wide. The rear is at 18 m. It reaches from 0.8 m left to 0.8 m right of
  // the axis and is 1.5 m high.
  const cv::Mat changed = drawn({{20.0, 0.0}, 0.0, {4.0, 1.6, 1.5}, true, ""});
  int left = kWidth_px, right = 0, top = kHeight_px, bottom = 0;
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      if (changed.at<std::uint8_t>(v, u) == 0) continue;
      left = std::min(left, u), right = std::max(right, u);
      top = std::min(top, v), bottom = std::max(bottom, v);
    }
  }
  EXPECT_NEAR(left, 609.6 - 721.5 * 0.8 / 18.0, 3.0);
  EXPECT_NEAR(right, 609.6 + 721.5 * 0.8 / 18.0, 3.0);
  EXPECT_NEAR(bottom, 172.9 + 721.5 * 1.65 / 18.0, 3.0);
  EXPECT_NEAR(top, 172.9 + 721.5 * 0.15 / 22.0, 3.0) << "the far upper edge, below the horizon";
}

TEST(Overlay, CutsAnObjectBesideTheCameraAtTheBorder) {
  // The object is 0.6 to 4.6 m ahead and 1.7 to 3.3 m to the left. A part of it is visible on the
  // left, below the horizon.
  const cv::Mat changed = drawn({{2.6, 2.5}, 0.0, {4.0, 1.6, 1.5}, false, ""});
  EXPECT_GT(cv::countNonZero(changed(cv::Rect(0, 0, 600, kHeight_px))), 50);
  EXPECT_EQ(cv::countNonZero(changed(cv::Rect(600, 0, kWidth_px - 600, kHeight_px))), 0);
  EXPECT_EQ(cv::countNonZero(changed(cv::Rect(0, 0, kWidth_px, 165))), 0);
}

TEST(Overlay, LeavesOutWhatLiesBehind) {
  EXPECT_EQ(cv::countNonZero(drawn({{-5.0, 0.0}, 0.0, {4.0, 1.6, 1.5}, true, "car"})), 0);
}

TEST(Overlay, DrawsFeaturesByKindAndNamesTheKinds) {
  FrameFigures figures;
  const cv::Mat grey(kHeight_px, kWidth_px, CV_8U, cv::Scalar(128));
  const int height = draw_overlay(grey, kitti_camera(), figures).rows;
  for (int kind = 0; kind < 4; ++kind) {
    figures.features.push_back(
        {{100.0F + 200.0F * static_cast<float>(kind), 100.0F}, static_cast<FeatureKind>(kind)});
  }
  const cv::Mat picture = draw_overlay(grey, kitti_camera(), figures);
  EXPECT_EQ(picture.at<cv::Vec3b>(100, 100), cv::Vec3b(177, 165, 154));
  EXPECT_EQ(picture.at<cv::Vec3b>(100, 300), cv::Vec3b(255, 184, 168));
  EXPECT_EQ(picture.at<cv::Vec3b>(100, 500), cv::Vec3b(255, 77, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(100, 700), cv::Vec3b(128, 128, 128)) << "the square is open";
  cv::Mat attached;
  cv::inRange(picture, cv::Scalar(0, 92, 255), cv::Scalar(0, 92, 255), attached);
  EXPECT_GT(cv::countNonZero(attached(cv::Rect(690, 90, 20, 20))), 8);
  EXPECT_GT(cv::countNonZero(attached.rowRange(kHeight_px, picture.rows)), 8) << "the key";
  EXPECT_GE(picture.rows, height);
}

TEST(Overlay, StandsAboveAStripWithTextAndKey) {
  FrameFigures figures;
  figures.lines = {"frame 1", "speed 10.00 +- 0.10 m/s"};
  const cv::Mat grey(kHeight_px, kWidth_px, CV_8U, cv::Scalar(128));
  const cv::Mat picture = draw_overlay(grey, kitti_camera(), figures);
  EXPECT_EQ(picture.cols, kWidth_px);
  EXPECT_GT(picture.rows, kHeight_px + 2 * LabelStyle(kWidth_px).line_height);
  cv::Mat above;
  cv::cvtColor(picture.rowRange(0, kHeight_px), above, cv::COLOR_BGR2GRAY);
  EXPECT_EQ(cv::countNonZero(above != grey), 0) << "without figures nothing covers the image";
}

TEST(Labels, DoNotCoverEachOtherAndStayInThePicture) {
  const LabelStyle style(640);
  cv::Mat picture(200, 640, CV_8UC3, cv::Scalar::all(200));
  LabelPlacer labels(&picture, style);
  const cv::Rect kept(400, 0, 240, 200);
  labels.reserve(kept);
  int num_placed = 0;
  std::vector<cv::Mat> before;
  for (int i = 0; i < 30; ++i) {
    const cv::Mat old = picture.clone();
    num_placed += labels.place("car 20 m", {100 + i, 100}, {0, 0, 255}) ? 1 : 0;
    cv::Mat changed;
    cv::cvtColor(cv::abs(picture - old), changed, cv::COLOR_BGR2GRAY);
    for (const cv::Mat& earlier : before)
      EXPECT_EQ(cv::countNonZero(earlier & changed), 0) << "label " << i;
    before.emplace_back(changed > 0);
    EXPECT_EQ(cv::countNonZero(changed(kept)), 0);
  }
  EXPECT_GE(num_placed, 3);
  EXPECT_LT(num_placed, 10) << "there is no room for all";
  EXPECT_FALSE(labels.place("a label that is far too long for the picture, whatever its place",
                            {300, 100}, {}));
}

TEST(Labels, GrowWithThePicture) {
  const int small = LabelStyle(640).size_of("speed").height;
  EXPECT_GE(small, 8) << "readable at 640 pixels";
  EXPECT_NEAR(LabelStyle(1280).size_of("speed").height, 2 * small, 2);
  EXPECT_EQ(LabelStyle(320).size_of("speed").height, small);
}

}  // namespace
}  // namespace plumb
