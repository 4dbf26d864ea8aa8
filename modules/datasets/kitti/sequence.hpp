/// Reads the folder of a KITTI sequence and assigns a time, a pose and a plane to each image.
///
/// Frames:
///   cam: the camera whose images are read. KITTI's poses and planes refer to the left grey camera;
///   for another camera they are moved by the baseline of the calibration.
/// Units:
///   SI; times are in microseconds since an epoch.
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

/// The radial distortion that remains in KITTI's "rectified" images: at the side of the image a
/// point is 9 px further out than a pinhole camera would project it. With these coefficients the
/// scale of the visual odometry drifts neither in turns of 90 degrees (on the recording day of
/// sequences 04 to 10) nor on straight roads; one coefficient alone cannot achieve both.
inline constexpr double kKittiResidualK1 = 0.0256;
inline constexpr double kKittiResidualK2 = -0.0076;

/// The times of odometry sequences begin at zero. This epoch (2001-09-09 01:46:40 UTC) is added so
/// that utime is above zero.
inline constexpr std::int64_t kOdometryEpoch_us = 1'000'000'000'000'000;

struct SequenceFrame {
  std::int64_t seq = 0;  ///< the number in the image's file name
  std::filesystem::path image;
  std::int64_t capture_us = 0;
  std::optional<PoseMatrix> T_world_cam;
  std::optional<TruePlane> plane;
};

struct Sequence {
  CameraModel camera;  ///< its size is 0 x 0 when the calibration does not state it
  bool colour_allowed = false;
  std::vector<SequenceFrame> frames;  ///< sorted by seq; times increase strictly
  std::vector<std::string> notes;     ///< sentences for the user: gaps, source of the truth
};

struct SequenceOptions {
  std::filesystem::path folder;
  bool need_images = true;       ///< false: without image folders, frame n is row n of times.txt
  int camera = 0;                ///< 0 and 1 are grey, 2 and 3 colour
  std::filesystem::path poses;   ///< when empty, the file of the folder is used
  std::filesystem::path planes;  ///< when empty, the file of the folder is used
  std::optional<double> residual_k1;
  std::optional<double> residual_k2;  ///< 0 when only k1 is given
  std::optional<double> camera_height_m;
  std::optional<double> readout_s;         ///< the default is that of calib.txt, else 0
  std::optional<std::int64_t> start, end;  ///< first and last frame number
};

/// Reads an odometry sequence or a raw drive. Throws InputError.
[[nodiscard]] Sequence read_sequence(const SequenceOptions& options);

}  // namespace plumb
