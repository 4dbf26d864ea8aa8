/// Compares estimated ground planes with true ones.
///
/// Units:
///   radians and metres inside; degrees and percent in what is printed.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "modules/datasets/kitti/plane_file.hpp"
#include "tools/evaluate/eval/estimate_csv.hpp"

namespace plumb {

/// A frame with an estimated and a true plane.
struct PlanePair {
  std::int64_t seq = 0;
  double true_height_m = 0.0;
  double height_m = 0.0;
  double true_pitch_rad = 0.0;
  double pitch_rad = 0.0;
  double roll_error_rad = 0.0;
};

struct AngleError {
  double mean_rad = 0.0;
  double std_rad = 0.0;
  double rms_rad = 0.0;
};

/// Errors divided by their stated standard deviations. NaN where the file states none.
struct Calibration {
  int num = 0;
  double nees = 0.0;            ///< mean squared ratio; 1 is right, more means overconfident
  double within_1_sigma = 0.0;  ///< share; 0.683 for normal errors
  double within_2_sigma = 0.0;  ///< share; 0.954
};

struct PlaneReport {
  int num_true = 0;      ///< frames with a true plane
  int num_compared = 0;  ///< of them, with an estimate
  int num_ok = 0;        ///< of them, measured in that frame (status ok), not held
  double height_error_mean_percent = 0.0;  ///< of |h - h_true| / h_true
  double height_error_median_percent = 0.0;
  double height_error_max_percent = 0.0;
  double height_bias_percent = 0.0;  ///< mean with its sign
  double within_7_ratio = 0.0;       ///< share of the compared frames
  AngleError pitch;
  AngleError roll;
  Calibration height_calibration;
  Calibration pitch_calibration;
  Calibration roll_calibration;
  std::vector<PlanePair> pairs;  ///< by seq
};

/// Rows without a true plane are passed over; true planes without a row only lower the coverage.
[[nodiscard]] PlaneReport compare_planes(const std::map<std::int64_t, TruePlane>& truth,
                                         const std::vector<EstimatedPlane>& estimates);

}  // namespace plumb
