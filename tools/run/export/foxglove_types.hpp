/// JSON schemas of the well-known Foxglove messages that plumb-export writes, and the values in
/// them. Names and fields are those that Foxglove documents.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/se3.hpp"

namespace plumb::foxglove {

using Json = nlohmann::json;

[[nodiscard]] Json compressed_image_schema();
[[nodiscard]] Json camera_calibration_schema();
[[nodiscard]] Json frame_transforms_schema();
[[nodiscard]] Json poses_in_frame_schema();
[[nodiscard]] Json pose_in_frame_schema();
[[nodiscard]] Json scene_update_schema();
[[nodiscard]] Json log_schema();

[[nodiscard]] Json time(std::int64_t time_us);
[[nodiscard]] Json vector3(const Eigen::Vector3d& v);
[[nodiscard]] Json quaternion(const Eigen::Matrix3d& R);
[[nodiscard]] Json pose(const Se3& T_frame_pose);

struct Colour {
  double r, g, b, a;
};
[[nodiscard]] Json colour(const Colour& colour);

/// An entity of a scene without anything in it.
[[nodiscard]] Json scene_entity(std::int64_t time_us, const char* frame, const std::string& id);
/// Pairs of points, each joined by a line.
[[nodiscard]] Json line_list(const std::vector<Eigen::Vector3d>& points, const Colour& colour);
[[nodiscard]] Json cube(const Se3& T_frame_centre, const Eigen::Vector3d& size_m,
                        const Colour& colour);
[[nodiscard]] Json text(const Eigen::Vector3d& place_m, const std::string& words,
                        const Colour& colour);
/// A scene that replaces the one before it on the same topic.
[[nodiscard]] Json scene(std::int64_t time_us, Json entities);

/// Base64 (RFC 4648), as JSON carries bytes.
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace plumb::foxglove
