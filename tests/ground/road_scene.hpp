/// Renders a flat textured road: images and VO results of a camera whose motion and plane are known
/// exactly.
///
/// Frames:
///   world: x right, y down, z forward; the road is the plane y = kRoadHeight below the world's
///   origin.
/// Units:
///   Metres; the simulated VO divides lengths by `metres_per_vo`.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "core/se3.hpp"
#include "modules/vo/vo.hpp"

namespace plumb::test {

inline constexpr double kRoadHeight = 1.5;

/// 640x240, f = 360, with a residual radial term.
[[nodiscard]] CameraModel scene_camera();

struct Shutter {
  double gain = 1.0;
  double bias = 0.0;
  double noise_grey = 0.0;
  int blur_px = 0;  ///< box of 2n+1 pixels in both directions
  Se3 step = {};    ///< motion to the next image, 0.1 s later; used with a rolling shutter
};

class GreyImage {
 public:
  GreyImage(int width_px, int height_px)
      : width_(width_px),
        height_(height_px),
        data_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}
  [[nodiscard]] ImageView view() const { return {data_.data(), width_, height_, width_}; }
  [[nodiscard]] std::uint8_t* row(int v) { return data_.data() + v * width_; }

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> data_;
};

[[nodiscard]] GreyImage render(const CameraModel& camera, const Se3& T_world_cam,
                               const Shutter& shutter, std::uint32_t seed);

/// Unit normal (down) and height of the road in the camera.
struct TruePlane {
  Eigen::Vector3d normal_cam;
  double height_m;
};
[[nodiscard]] TruePlane plane_in(const Se3& T_world_cam);

/// A car's path with constant speed and yaw rate (left positive) and sinusoidal pitch.
struct Drive {
  double step_m = 0.8;
  double turn_left_rad = 0.0;  ///< per frame
  double pitch_amplitude_rad = 0.0;
  double mount_pitch_rad = 0.01;  ///< nose down
  double mount_roll_rad = 0.01;   ///< right side down
  [[nodiscard]] std::vector<Se3> poses(int num_frames) const;
};

/// Settings of a perfect VO, except that the depth of its road points scatters.
struct VoScript {
  double metres_per_vo = 1.3;
  double point_rel_std = 0.02;
  int num_points = 120;
  int num_outliers = 20;
  int first_ok_frame = 2;  ///< earlier frames are initialising
};
/// Fills `vo` with its result for frame `k` of `poses`.
void script_vo(const std::vector<Se3>& poses, int k, const VoScript& script, VoOutput* vo);

}  // namespace plumb::test
