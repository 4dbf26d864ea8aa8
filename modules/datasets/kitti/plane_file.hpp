/// True ground planes per frame: rows "frame nx ny nz height_m ...", further columns are not read.
///
/// Frames   cam: x right, y down, z forward. Plane: normal_cam . X = height, the normal points DOWN
/// to the road.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>

namespace plumb {

struct TruePlane {
  Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();  ///< unit
  double height_m = 0.0;

  /// ISO 8855 with the body's axes along the camera's: pitch nose DOWN positive, roll right side
  /// down positive.
  [[nodiscard]] double pitch_rad() const;
  [[nodiscard]] double roll_rad() const;
};

/// Planes by frame number. Throws InputError for a wrong row, a frame given twice, a normal that is
/// not of length one to 1 % or does not point down, and a height that is not above zero.
[[nodiscard]] std::map<std::int64_t, TruePlane> read_planes(const std::filesystem::path& path);

}  // namespace plumb
