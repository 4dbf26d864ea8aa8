/// The standard ROS 2 messages that plumb-export writes: their definitions, as a bag carries them,
/// and their bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/camera_model.hpp"
#include "core/se3.hpp"
#include "tools/run/export/vehicle_frame.hpp"

namespace plumb::ros2 {

using Bytes = std::vector<std::uint8_t>;

/// A type and its definition, with those of the types in it (encoding "ros2msg").
struct Type {
  std::string name;
  std::string definition;
};

[[nodiscard]] Type odometry_type();
[[nodiscard]] Type compressed_image_type();
[[nodiscard]] Type camera_info_type();
[[nodiscard]] Type tf_message_type();
[[nodiscard]] Type diagnostic_array_type();

struct Transform {
  const char* parent;
  const char* child;
  Se3 T_parent_child;
};

struct Diagnosis {
  enum Level : std::uint8_t { kOk = 0, kWarn = 1, kError = 2, kStale = 3 };
  Level level = kOk;
  std::string name;
  std::string message;
  std::vector<std::pair<std::string, std::string>> values;
};

/// base_link in odom.
/// @param twist  null while it is not known: zero with a variance of kUnknownVariance
[[nodiscard]] Bytes odometry(std::int64_t time_us, const Se3& pose, const Matrix6d& covariance,
                             const VehicleTwist* twist);
inline constexpr double kUnknownVariance = 1e9;

[[nodiscard]] Bytes compressed_image(std::int64_t time_us, std::span<const std::uint8_t> jpeg);
[[nodiscard]] Bytes camera_info(std::int64_t time_us, const CameraModel& camera);
[[nodiscard]] Bytes tf_message(std::int64_t time_us, const std::vector<Transform>& transforms);
[[nodiscard]] Bytes diagnostic_array(std::int64_t time_us, const std::vector<Diagnosis>& all);

}  // namespace plumb::ros2
