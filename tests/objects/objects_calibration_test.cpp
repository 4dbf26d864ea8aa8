#include <gtest/gtest.h>

#include "modules/objects/objects_node.hpp"

namespace plumb {
namespace {

CameraModel camera(double f_px) {
  CameraModel model;
  model.width_px = 1242;
  model.height_px = 375;
  model.fx_px = model.fy_px = f_px;
  model.cx_px = 609.6;
  model.cy_px = 172.9;
  return model;
}

camera_calibration_t calibration(double f_px) { return to_wire(camera(f_px), 0); }

ObjectsNode make_node() {
  return {DetectionsConfig{}, ObjectsConfig{}, GroundConfig{}, [](const objects_t&) {}};
}

TEST(ObjectsCalibration, AnotherOneHoldsAfterThreeEqualMessages) {
  ObjectsNode node = make_node();
  EXPECT_EQ(node.take_calibration(calibration(721.5)), nullptr);
  EXPECT_TRUE(node.calibrated());
  EXPECT_STREQ(node.take_calibration(calibration(500.0)),
               "calibration contradicts the earlier ones");
  EXPECT_EQ(node.take_calibration(calibration(721.5)), nullptr);
  EXPECT_NE(node.take_calibration(calibration(500.0)), nullptr);
  EXPECT_NE(node.take_calibration(calibration(500.0)), nullptr);
  EXPECT_EQ(node.take_calibration(calibration(500.0)), nullptr);
  EXPECT_NE(node.take_calibration(calibration(721.5)), nullptr) << "the other one holds now";
}

TEST(ObjectsCalibration, TheConfigurationHoldsAgainstAnyMessage) {
  ObjectsNode node = make_node();
  node.configure_camera(camera(721.5));
  EXPECT_TRUE(node.calibrated());
  for (int i = 0; i < 4; ++i) EXPECT_NE(node.take_calibration(calibration(500.0)), nullptr);
  EXPECT_EQ(node.take_calibration(calibration(721.5)), nullptr);
}

}  // namespace
}  // namespace plumb
