/// Reads KITTI tracking files: labels with 3D boxes, trackers' output without them, and the camera
/// of a sequence.
///
/// Format:
///   Each line has frame, id, type, truncated, occluded, alpha, left, top, right, bottom,
///   height, width, length, x, y, z, rotation_y and perhaps a score. Trackers write -1 or -10
///   for what they do not know. DontCare regions and empty boxes, which some trackers write at
///   the image's border, are left out.
/// Frames:
///   Boxes are in the image of the left colour camera. Positions (middle of the underside) are
///   in rectified camera 0; read_tracking_camera() gives the offset to the colour camera.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/camera_model.hpp"
#include "modules/detections/detection.hpp"

namespace plumb {

/// The class of a type's name; kUnknown for a name without one.
[[nodiscard]] ObjectClass object_class_of(std::string_view name);
/// The name of a class in KITTI's labels; "Misc" for kUnknown.
[[nodiscard]] const char* kitti_name_of(ObjectClass object_class);

struct TrackingRow {
  int frame = 0;
  Detection detection;
  bool has_box3d = false;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();     ///< length, width, height
  Eigen::Vector3d foot_cam0 = Eigen::Vector3d::Zero();  ///< middle of the underside
  double rotation_y_rad = 0.0;  ///< about cam's y; 0: the object's x along the camera's
};

/// Rows in the order of the file. Throws InputError for a wrong row and for an object that has two
/// boxes in one frame.
[[nodiscard]] std::vector<TrackingRow> read_tracking(const std::filesystem::path& path);

struct TrackingCamera {
  CameraModel model;
  Eigen::Vector3d t_cam_cam0 = Eigen::Vector3d::Zero();  ///< p_cam = p_cam0 + t
};

/// The camera P2 of a calibration file. The file lacks the image size, so the benchmark's usual
/// size is taken.
[[nodiscard]] TrackingCamera read_tracking_camera(const std::filesystem::path& path);

/// The rows of one frame as a detector's message; rows beyond its capacity are left out.
/// 10 frames a second.
[[nodiscard]] DetectionFrame detections_of_frame(const std::vector<TrackingRow>& rows, int frame);

}  // namespace plumb
