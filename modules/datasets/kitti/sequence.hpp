/// A KITTI sequence as it lies in its folder: which image belongs to which time, pose and plane.
///
/// Frames   cam: the camera whose images are converted. Poses and planes are KITTI's, of the left
///          grey camera; for another camera they are moved to it by the calibration's baseline.
/// Units    SI; times in microseconds since an epoch.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/camera_model.hpp"
#include "modules/datasets/kitti/plane_file.hpp"
#include "modules/datasets/kitti/pose_file.hpp"

namespace plumb {

/// "Rectified" KITTI images keep radial terms: a point at the image's side is 9 px further out than a pinhole puts it. Measured
/// where VO's scale drifts neither in 90 degree turns (04 .. 10's day) nor on the straight; one term cannot do both.
inline constexpr double kKittiResidualK1 = 0.0256;
inline constexpr double kKittiResidualK2 = -0.0076;

/// Odometry times begin at zero; events begin here (2001-09-09 01:46:40 UTC), so that utime is
/// above zero.
inline constexpr std::int64_t kOdometryEpoch_us = 1'000'000'000'000'000;

struct SequenceFrame {
  std::int64_t seq = 0;  ///< the number in the file's name
  std::filesystem::path image;
  std::int64_t capture_us = 0;
  std::optional<PoseMatrix> T_world_cam;
  std::optional<TruePlane> plane;
};

struct Sequence {
  CameraModel camera;  ///< size 0 x 0 when the calibration does not state it
  bool colour_allowed = false;
  std::vector<SequenceFrame> frames;  ///< by seq, times strictly increasing
  std::vector<std::string> notes;     ///< what the user should know: gaps, where truth came from
};

struct SequenceOptions {
  std::filesystem::path folder;
  int camera = 0;                ///< 0, 1 grey; 2, 3 colour
  std::filesystem::path poses;   ///< empty: look in the folder
  std::filesystem::path planes;  ///< empty: look in the folder
  std::optional<double> residual_k1;
  std::optional<double> residual_k2;  ///< given k1 alone: 0
  std::optional<double> camera_height_m;
  std::optional<double> readout_s;         ///< else calib.txt's, else 0
  std::optional<std::int64_t> start, end;  ///< first and last frame number
};

/// Reads either layout. Throws InputError.
[[nodiscard]] Sequence read_sequence(const SequenceOptions& options);

}  // namespace plumb
