/// Reads the true ground plane of each frame from rows "frame nx ny nz height_m ...". Further
/// columns are ignored.
///
/// Frames:
///   cam: x right, y down, z forward. The plane is normal_cam . X = height; its normal points DOWN
///   to the road.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>

namespace plumb {

struct TruePlane {
  Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();  ///< of unit length
  double height_m = 0.0;

  /// The angles follow ISO 8855 with the body's axes along those of the camera: pitch nose DOWN
  /// positive, roll right side down positive.
  [[nodiscard]] double pitch_rad() const;
  [[nodiscard]] double roll_rad() const;
};

/// Reads the planes by frame number. Throws InputError for a wrong row, a frame given twice, a
/// normal whose length differs from one by more than 1 % or that does not point down, and a height
/// that is not above zero.
[[nodiscard]] std::map<std::int64_t, TruePlane> read_planes(const std::filesystem::path& path);

}  // namespace plumb
