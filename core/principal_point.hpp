/// Whether a camera's principal point is where a sound calibration has it. A lens is mounted over
/// the middle of its sensor; a principal point far off it is that of another image size, of a
/// picture that was cropped after the calibration, or a slip.
#pragma once

#include <cmath>

#include "core/camera_model.hpp"

namespace plumb {

/// Largest distance to the middle of the picture, as a share of width and height.
inline constexpr double kMaxPrincipalPointOffset = 0.1;
inline constexpr const char* kPrincipalPointIsOff =
    "the calibration's principal point is more than 10 % of the picture off its middle";

[[nodiscard]] inline bool is_principal_point_central(const CameraModel& camera) {
  const double off_u_px = camera.cx_px - 0.5 * (camera.width_px - 1);
  const double off_v_px = camera.cy_px - 0.5 * (camera.height_px - 1);
  return std::abs(off_u_px) <= kMaxPrincipalPointOffset * camera.width_px &&
         std::abs(off_v_px) <= kMaxPrincipalPointOffset * camera.height_px;
}

}  // namespace plumb
