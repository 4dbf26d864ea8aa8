/// Reads KITTI calibration files, whose lines are "KEY: number number ...".
///
/// Errors:
///   Every function throws InputError, with file, line and key where they are known.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/camera_model.hpp"
#include "core/se3.hpp"

namespace plumb {

class CalibrationFile {
 public:
  /// Reads the file. Values are parsed only on request, because KITTI's files also contain dates
  /// and other text.
  explicit CalibrationFile(const std::filesystem::path& path);

  /// The `count` numbers of `key`. Throws when the key is missing or given twice, or when its
  /// values are not `count` finite numbers.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count) const;
  [[nodiscard]] bool has(const std::string& key) const { return entries_.count(key) != 0; }
  /// The number of `key`, or nothing when the key is missing.
  [[nodiscard]] std::optional<double> optional_number(const std::string& key) const;
  /// The rigid transform with the 3x3 rotation `r_key` and the translation `t_key` (raw drives).
  [[nodiscard]] Se3 rigid(const std::string& r_key, const std::string& t_key) const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  struct Entry {
    int line = 0;
    int count = 0;
    std::string text;
  };
  std::filesystem::path path_;
  std::map<std::string, Entry> entries_;
};

/// A rectified camera as its projection matrix describes it.
struct RectifiedCamera {
  CameraModel model;             ///< without the image size
  Eigen::Vector3d t_left_cam_m;  ///< position of the camera in the left grey camera's frame
};

/// Reads the 12 numbers of `key` ("P0", "P_rect_02"). Throws when a focal length is not above zero,
/// when the matrix has a skew, or when its last row is not that of a pinhole camera.
[[nodiscard]] RectifiedCamera read_projection(const CalibrationFile& file, const std::string& key);

}  // namespace plumb
