/// Errors of the height by the true step: heights in [vo] become metres by the length of VO's path
/// beside that of the truth, and are compared with true heights. This asks how well the scale is
/// known, which the reported height in metres cannot tell.
///
/// Units:
///   Metres and per cent; [vo] is the unit of visual odometry.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "modules/datasets/kitti/plane_file.hpp"
#include "modules/datasets/kitti/pose_file.hpp"

namespace plumb {

/// What of a row of plumb-replay's table the height needs. Heights are empty where the cue was not
/// used or no plane is held.
struct HeightRow {
  std::int64_t seq = 0;
  bool vo_ok = false;
  std::int64_t scale_epoch = 0;
  double step_vo = 0.0;             ///< length of VO's step since the image before
  std::optional<double> log_scale;  ///< of the filter: ln(metres per [vo])
  std::optional<double> dense_vo;
  std::optional<double> points_vo;
};

/// Throws InputError for a table that is not plumb-replay's.
[[nodiscard]] std::vector<HeightRow> read_height_rows(const std::filesystem::path& path);

struct HeightError {
  std::int64_t seq = 0;
  double error_percent = 0.0;  ///< estimated / true - 1
};

/// Errors of what plays a part, by name: fused, dense, points, and constant, which states the
/// nominal height in every frame that fused has.
using HeightErrors = std::map<std::string, std::vector<HeightError>>;

/// @param truth     true planes by frame; where one is missing, `height_m` stands in
/// @param height_m  nominal height of the camera, by which the filter's scale is a height
/// Throws InputError when poses and rows differ in number.
[[nodiscard]] HeightErrors height_by_true_step(const std::vector<PoseMatrix>& poses,
                                               const std::vector<HeightRow>& rows,
                                               const std::map<std::int64_t, TruePlane>& truth,
                                               double height_m);

struct HeightSummary {
  int num_frames = 0;
  double mean_percent = 0.0;  ///< of the absolute error; NaN without frames
  double bias_percent = 0.0;
  double within_7_ratio = 0.0;
};

[[nodiscard]] HeightSummary summarize_heights(const std::vector<HeightError>& errors);

}  // namespace plumb
