#include "modules/camera/front_end.hpp"

#include <gtest/gtest.h>

#include "tests/camera/pattern.hpp"

namespace plumb {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 180;

CameraConfig calibrated() {
  CameraConfig config;
  config.fx_px = 250.0;
  config.fy_px = 251.0;
  config.cx_px = 160.5;
  config.cy_px = 88.0;
  return config;
}

std::string why(const CameraConfig& config) {
  return why_unusable(config, kWidth, kHeight, nullptr);
}

TEST(FrontEnd, ACalibratedCameraIsUsable) { EXPECT_EQ(why(calibrated()), ""); }

TEST(FrontEnd, SaysWhatAnUnusableConfigurationLacks) {
  EXPECT_NE(why(CameraConfig{}).find("camera.fx_px"), std::string::npos);
  CameraConfig outside = calibrated();
  outside.cx_px = kWidth;
  EXPECT_NE(why(outside).find("camera.cx_px"), std::string::npos);
  CameraConfig tangential = calibrated();
  tangential.distortion = "fisheye";
  tangential.p1 = 0.01;
  EXPECT_NE(why(tangential).find("camera.p1"), std::string::npos);
  CameraConfig fourth = calibrated();
  fourth.k4 = 0.01;
  EXPECT_NE(why(fourth).find("camera.k4"), std::string::npos);
  CameraConfig polygon = calibrated();
  polygon.mask_polygon = "1,2 3,4";
  EXPECT_NE(why(polygon).find("camera.mask_polygon"), std::string::npos);
  CameraConfig covered = calibrated();
  covered.mask_top_rows = kHeight;
  EXPECT_NE(why(covered).find("less than a tenth"), std::string::npos);
  const std::vector<std::uint8_t> full(static_cast<std::size_t>(kWidth * kHeight), 1);
  EXPECT_NE(why_unusable(calibrated(), kWidth, kHeight, full.data()), "");
  EXPECT_NE(why_unusable(calibrated(), 8, 8, nullptr), "");
}

TEST(FrontEnd, PublishesTheRectifiedPinholeAndTheRigsHeight) {
  CameraConfig config = calibrated();
  config.rectified_fx_px = 200.0;
  config.rectified_cy_px = 90.0;
  config.residual_k1 = 0.004;
  config.residual_k2 = -0.001;
  config.readout_s = 0.015;
  config.camera_height_m = 1.42;
  const CameraModel model = published_model(config, kWidth, kHeight);
  EXPECT_EQ(model.width_px, kWidth);
  EXPECT_EQ(model.height_px, kHeight);
  EXPECT_EQ(model.fx_px, 200.0);
  EXPECT_EQ(model.fy_px, 251.0);
  EXPECT_EQ(model.cx_px, 160.5);
  EXPECT_EQ(model.cy_px, 90.0);
  EXPECT_EQ(model.residual_k1, 0.004);
  EXPECT_EQ(model.residual_k2, -0.001);
  EXPECT_EQ(model.readout_s, 0.015);
  EXPECT_EQ(model.camera_height_m, 1.42);
}

TEST(FrontEnd, WithoutDistortionAndMaskEveryByteArrives) {
  FrontEnd front_end(calibrated(), kWidth, kHeight, nullptr);
  const cv::Mat image = test::noise(kHeight, kWidth, 21);
  cv::Mat out(image.size(), CV_8U);
  NullProbe probe;
  EXPECT_EQ(front_end.process(test::view_of(image), out.data, &probe), ImageFault::kNone);
  EXPECT_EQ(cv::norm(image, out, cv::NORM_INF), 0.0);
}

TEST(FrontEnd, UnseenCornersAreFilledLikeTheMask) {
  CameraConfig config = calibrated();
  config.rectified_fx_px = 180.0;
  config.rectified_fy_px = 180.0;
  ASSERT_EQ(why(config), "");
  FrontEnd front_end(config, kWidth, kHeight, nullptr);
  const cv::Mat image = test::noise(kHeight, kWidth, 22);
  cv::Mat out(image.size(), CV_8U);
  NullProbe probe;
  (void)front_end.process(test::view_of(image), out.data, &probe);
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(out(cv::Rect(0, 0, 40, kHeight)), &low, &high);
  EXPECT_EQ(low, high);
}

TEST(FrontEnd, AFrozenCameraIsNoticedThroughTheMask) {
  CameraConfig config = calibrated();
  config.mask_bottom_rows = 40;
  FrontEnd front_end(config, kWidth, kHeight, nullptr);
  const cv::Mat image = test::noise(kHeight, kWidth, 23);
  cv::Mat out(image.size(), CV_8U);
  NullProbe probe;
  ImageFault fault = ImageFault::kNone;
  for (int i = 0; i < 4; ++i) fault = front_end.process(test::view_of(image), out.data, &probe);
  EXPECT_EQ(fault, ImageFault::kFrozen);
}

}  // namespace
}  // namespace plumb
