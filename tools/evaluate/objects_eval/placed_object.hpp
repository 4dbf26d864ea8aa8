/// Reads the places of objects from the table of plumb-replay --objects.
///
/// Frames:
///   ground: x forward, y left, on the road under the camera, of the row's image.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>

namespace plumb {

struct PlacedObject {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d cov_m2 = Eigen::Matrix2d::Identity();  ///< positive definite
};

/// By sequence number of the image and track.
using PlacedObjects = std::map<std::pair<std::int64_t, std::int64_t>, PlacedObject>;

/// Objects without a place are left out. Throws InputError with file and line for a missing column,
/// text that is not a number, a place without a valid covariance, and a track with two rows in one
/// image.
[[nodiscard]] PlacedObjects read_placed_objects(const std::filesystem::path& csv);

}  // namespace plumb
