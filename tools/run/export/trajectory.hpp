/// Trajectory files that others read: TUM (evo, rpg_trajectory_evaluation) and KITTI.
#pragma once

#include <filesystem>
#include <string>

#include "tools/run/export/drive_results.hpp"

namespace plumb {

/// Whose pose a trajectory states, and in which axes.
enum class TrajectoryFrame {
  kOfCamera,   ///< T_world_cam, as the messages have it
  kOfVehicle,  ///< T_odom_vehicle of vehicle_frame.hpp
};

/// Writes "time x y z qx qy qz qw" for each image with a pose: the capture time [s], the position
/// [m] and the rotation. The numbers read back to the same bits. Returns the number of rows.
std::int64_t write_tum(const DriveResults& drive, TrajectoryFrame frame,
                       const std::filesystem::path& path);

/// Writes a row of 12 numbers for each image, as plumb-replay --poses does. Returns the number of
/// rows.
std::int64_t write_kitti(const DriveResults& drive, TrajectoryFrame frame,
                         const std::filesystem::path& path);

}  // namespace plumb
