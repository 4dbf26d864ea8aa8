#include "modules/camera/calibration_keeper_wire.hpp"

#include <gtest/gtest.h>

#include "modules/camera/image_wire.hpp"

namespace plumb {
namespace {

camera_calibration_t calibration(double fx_px) {
  CameraModel camera;
  camera.width_px = 320;
  camera.height_px = 96;
  camera.fx_px = camera.fy_px = fx_px;
  camera.cx_px = 160.0;
  camera.cy_px = 48.0;
  return to_wire(camera, 0);
}

CameraModel camera(double fx_px) {
  CameraModel model;
  EXPECT_EQ(from_wire(calibration(fx_px), &model), nullptr);
  return model;
}

TEST(CalibrationKeeper, TakesTheFirstOneAndItsRepetitions) {
  CalibrationKeeper keeper;
  EXPECT_FALSE(keeper.is_known());
  EXPECT_EQ(keeper.take(calibration(250.0)), nullptr);
  EXPECT_TRUE(keeper.take_change());
  EXPECT_EQ(keeper.take(calibration(250.0)), nullptr);
  EXPECT_FALSE(keeper.take_change());
  EXPECT_EQ(keeper.camera().fx_px, 250.0);
}

TEST(CalibrationKeeper, OneContradictionIsDoubtedUntilTheNextConfirmation) {
  CalibrationKeeper keeper;
  ASSERT_EQ(keeper.take(calibration(250.0)), nullptr);
  EXPECT_STREQ(keeper.take(calibration(500.0)), "calibration contradicts the earlier ones");
  EXPECT_TRUE(keeper.is_doubted());
  EXPECT_EQ(keeper.take(calibration(250.0)), nullptr);
  EXPECT_FALSE(keeper.is_doubted());
  EXPECT_EQ(keeper.camera().fx_px, 250.0);
}

TEST(CalibrationKeeper, AWrongFirstOneGivesWay) {
  CalibrationKeeper keeper;
  ASSERT_EQ(keeper.take(calibration(500.0)), nullptr);
  EXPECT_TRUE(keeper.take_change());
  EXPECT_NE(keeper.take(calibration(250.0)), nullptr);
  EXPECT_NE(keeper.take(calibration(250.0)), nullptr);
  EXPECT_TRUE(keeper.is_doubted());
  EXPECT_EQ(keeper.take(calibration(250.0)), nullptr);
  EXPECT_TRUE(keeper.take_change());
  EXPECT_FALSE(keeper.is_doubted());
  EXPECT_EQ(keeper.camera().fx_px, 250.0);
}

TEST(CalibrationKeeper, ContradictionsThatDisagreeAreNeverTaken) {
  CalibrationKeeper keeper;
  ASSERT_EQ(keeper.take(calibration(250.0)), nullptr);
  for (int i = 0; i < 6; ++i) EXPECT_NE(keeper.take(calibration(400.0 + i)), nullptr);
  EXPECT_TRUE(keeper.is_doubted());
  EXPECT_EQ(keeper.camera().fx_px, 250.0);
}

TEST(CalibrationKeeper, TheConfigurationHoldsAgainstAnyMessage) {
  CalibrationKeeper keeper;
  keeper.configure(camera(250.0));
  EXPECT_TRUE(keeper.take_change());
  for (int i = 0; i < 6; ++i) {
    EXPECT_STREQ(keeper.take(calibration(500.0)),
                 "calibration contradicts the one that the configuration states");
  }
  EXPECT_FALSE(keeper.is_doubted()) << "what the configuration states is not in doubt";
  EXPECT_FALSE(keeper.take_change());
  EXPECT_EQ(keeper.camera().fx_px, 250.0);
}

TEST(CalibrationKeeper, RefusesImagesThatNoReaderHasRoomFor) {
  camera_calibration_t message = calibration(250.0);
  message.width = message.height = 8192;
  CalibrationKeeper keeper;
  EXPECT_STREQ(keeper.take(message), "calibration: the images have more pixels than 1920 x 1200");
  EXPECT_FALSE(keeper.is_known());
}

}  // namespace
}  // namespace plumb
