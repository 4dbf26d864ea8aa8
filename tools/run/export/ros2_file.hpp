/// A ROS 2 bag: MCAP with the profile "ros2" and standard messages in CDR, which `ros2 bag` and
/// Foxglove open as it is.
///
/// Topics:
///   /odom                     nav_msgs/msg/Odometry: base_link in odom, with covariances
///   /camera/image/compressed  sensor_msgs/msg/CompressedImage
///   /camera/camera_info       sensor_msgs/msg/CameraInfo, with every image
///   /tf, /tf_static           tf2_msgs/msg/TFMessage: odom -> base_link -> camera -> road
///   /diagnostics              diagnostic_msgs/msg/DiagnosticArray: motion, road plane and, where
///   the
///                             log holds it, the health of each process
/// Frames:
///   As in foxglove_file.hpp.
#pragma once

#include <filesystem>
#include <memory>

#include "tools/run/export/drive_sink.hpp"

namespace plumb {

/// Creates or replaces the file. `drive` outlives the sink. Throws InputError.
[[nodiscard]] std::unique_ptr<DriveSink> make_ros2_file(const DriveResults& drive,
                                                        const std::filesystem::path& path);

}  // namespace plumb
