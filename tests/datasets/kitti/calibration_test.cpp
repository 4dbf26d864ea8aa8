#include "modules/datasets/kitti/calibration.hpp"

#include <gtest/gtest.h>

#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::expect_contains;
using test::input_error_of;

class Calibration : public ::testing::Test {
 protected:
  CalibrationFile file(const std::string& text) {
    return CalibrationFile(folder_.write("calib.txt", text));
  }
  std::string projection_error(const std::string& text) {
    return input_error_of([&] { (void)read_projection(file(text), "P0"); });
  }
  test::TempFolder folder_;
};

TEST_F(Calibration, ReadsAProjectionAndWhereItsCameraStands) {
  // KITTI's P3 of the sequences 04 to 12. Its camera is 0.53 m to the right of the left grey one.
  const auto camera = read_projection(
      file("P3: 707.0912 0 601.8873 -333.4597 0 707.0912 183.1104 1.930130 0 0 1 0.003318498\n"),
      "P3");
  EXPECT_DOUBLE_EQ(camera.model.fx_px, 707.0912);
  EXPECT_DOUBLE_EQ(camera.model.cx_px, 601.8873);
  EXPECT_DOUBLE_EQ(camera.model.cy_px, 183.1104);
  // P3 projects the origin of the left camera to the pixel to which K projects -t_left_cam.
  const Eigen::Vector3d t = camera.t_left_cam_m;
  EXPECT_NEAR(707.0912 * -t.x() + 601.8873 * -t.z(), -333.4597, 1e-9);
  EXPECT_NEAR(707.0912 * -t.y() + 183.1104 * -t.z(), 1.930130, 1e-9);
  EXPECT_NEAR(-t.z(), 0.003318498, 1e-12);
  EXPECT_GT(t.x(), 0.4);
}

TEST_F(Calibration, IgnoresLinesItHasNoUseFor) {
  const auto f =
      file("# a comment: 1\ncalib_time: 09-Jan-2012 13:57:47\nresidual_k1: 0\n\nnonsense\n");
  EXPECT_DOUBLE_EQ(*f.optional_number("residual_k1"), 0.0);
  EXPECT_FALSE(f.optional_number("camera_height_m"));
}

TEST_F(Calibration, SaysWhatIsMissingOrNoNumber) {
  expect_contains(projection_error("P1: 1 0 0 0 0 1 0 0 0 0 1 0\n"), "calib.txt: P0 is missing");
  expect_contains(projection_error("\nP0: 1 0 0 0 0 one 0 0 0 0 1 0\n"),
                  "calib.txt:2: P0: 'one' is not a finite number");
  expect_contains(projection_error("P0: 1 0 0 0 0 nan 0 0 0 0 1 0\n"), "'nan'");
  expect_contains(projection_error("P0: 1 0 0 0 0 1 0 0 0 0 1\n"), "has 11 numbers, expected 12");
  expect_contains(projection_error("P0: 1\nP0: 1\n"), "calib.txt:2: P0 is given twice");
  expect_contains(projection_error("P0: -1 0 0 0 0 1 0 0 0 0 1 0\n"), "pinhole");
  expect_contains(projection_error("P0: 1 0 0 0 0 1 0 0 0 0 2 0\n"), "pinhole");
  expect_contains(input_error_of([&] { CalibrationFile(folder_ / "none.txt"); }), "none.txt");
}

TEST_F(Calibration, ReadsARigidMotionAndRefusesWhatIsNoRotation) {
  const Se3 T = file("R: 0 -1 0 1 0 0 0 0 1\nT: 1 2 3\n").rigid("R", "T");
  EXPECT_TRUE((T * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(1, 3, 3)));
  expect_contains(
      input_error_of([&] { (void)file("R: 2 0 0 0 1 0 0 0 1\nT: 0 0 0\n").rigid("R", "T"); }),
      "R is not a rotation");
}

}  // namespace
}  // namespace plumb
