/// KITTI tracking files: labels with 3D boxes, trackers' output without, and the camera of a
/// sequence.
///
/// Format   per line: frame id type truncated occluded alpha left top right bottom height width
/// length x y z
///          rotation_y [score]; -1 or -10 where a tracker says nothing. DontCare regions and
///          empty boxes (trackers write some at the image's border) are left out.
/// Frames   boxes in the image of the left colour camera; positions (middle of the underside) in
/// rectified
///          camera 0, from which read_tracking_camera's offset leads to the colour camera.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "core/camera_model.hpp"
#include "modules/detections/detection.hpp"

namespace plumb {

struct TrackingRow {
  int frame = 0;
  Detection detection;
  bool has_box3d = false;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();     ///< length, width, height
  Eigen::Vector3d foot_cam0 = Eigen::Vector3d::Zero();  ///< middle of the underside
  double rotation_y_rad = 0.0;  ///< about cam's y; 0: the object's x along the camera's
};

/// In order of the file. Throws InputError for a wrong row and for an object that has two boxes in
/// one frame.
[[nodiscard]] std::vector<TrackingRow> read_tracking(const std::filesystem::path& path);

struct TrackingCamera {
  CameraModel model;
  Eigen::Vector3d t_cam_cam0 = Eigen::Vector3d::Zero();  ///< p_cam = p_cam0 + t
};

/// P2 of a calib file. The image size, which the file does not hold, is that of the benchmark's
/// usual images.
[[nodiscard]] TrackingCamera read_tracking_camera(const std::filesystem::path& path);

/// The rows of one frame as a detector's message; rows beyond its capacity are left out.
/// 10 frames a second.
[[nodiscard]] DetectionFrame detections_of_frame(const std::vector<TrackingRow>& rows, int frame);

}  // namespace plumb
