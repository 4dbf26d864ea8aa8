#include "tools/learn/calibrate/camera_parameters.hpp"

#include <gtest/gtest.h>

#include "core/input_error.hpp"
#include "tests/support/expect_throw.hpp"

namespace plumb {
namespace {

TEST(CameraParameters, SetWhatTheyGet) {
  for (const CameraParameter& p : camera_parameters()) {
    CameraModel camera;
    camera.fx_px = camera.fy_px = 700.0;
    p.set(&camera, p.get(camera) + 1.5);
    EXPECT_NEAR(p.get(camera) - p.get(CameraModel{}), p.key == std::string("focal") ? 701.5 : 1.5,
                1e-12)
        << p.key;
  }
}

TEST(CameraParameters, FocalLengthKeepsThePixelsShape) {
  CameraModel camera;
  camera.fx_px = 700.0;
  camera.fy_px = 710.0;
  camera_parameters()[2].set(&camera, 770.0);
  EXPECT_DOUBLE_EQ(camera.fy_px, 781.0);
}

TEST(CameraParameters, NamesAreReadInTheirOrderAndOnce) {
  const auto two = parse_parameters("k2,k1");
  ASSERT_EQ(two.size(), 2U);
  EXPECT_STREQ(two[0]->key, "k2");
  EXPECT_THROW((void)parse_parameters("k1,tilt"), InputError);
  EXPECT_THROW((void)parse_parameters("k1,k1"), InputError);
}

}  // namespace
}  // namespace plumb
