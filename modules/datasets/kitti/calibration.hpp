/// KITTI calibration files: lines "KEY: number number ...".
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
  /// Throws InputError when the file cannot be read. Values are looked at only when asked for:
  /// KITTI's files hold dates and other text beside them.
  explicit CalibrationFile(const std::filesystem::path& path);

  /// The `count` numbers of `key`. Throws InputError when the key is missing, given twice, or its
  /// values are not `count` finite numbers.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count) const;
  [[nodiscard]] bool has(const std::string& key) const { return entries_.count(key) != 0; }
  /// One number, or nothing when the key is missing.
  [[nodiscard]] std::optional<double> optional_number(const std::string& key) const;
  /// 3x3 rotation `r_key` and translation `t_key` (raw drives).
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

/// What a projection matrix says about one rectified camera.
struct RectifiedCamera {
  CameraModel model;             ///< without image size
  Eigen::Vector3d t_left_cam_m;  ///< where it is, in the left grey camera's frame
};

/// Reads `key` ("P0", "P_rect_02") as 12 numbers. Throws InputError when focal lengths are not
/// above zero or the matrix has a skew or another last row than a pinhole's.
[[nodiscard]] RectifiedCamera read_projection(const CalibrationFile& file, const std::string& key);

}  // namespace plumb
