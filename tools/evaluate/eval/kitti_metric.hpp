/// The KITTI odometry benchmark's error of a trajectory over segments of fixed length.
///
/// Metric:
///   It is that of the benchmark's development kit. Path lengths are those of the truth in single
///   precision. A segment begins at every tenth frame and ends at the first frame that lies more
///   than L further. E = inv(inv(Est_f) Est_l) inv(Gt_f) Gt_l with general inverses, t = |E_t| / L,
///   r = angle(E_R) / L. Speeds assume ten frames a second. Only relative poses count, so neither
///   file need begin with the identity.
/// Units:
///   Metres, radians, m/s; ratios are not percent.
#pragma once

#include <string>
#include <vector>

#include "modules/datasets/kitti/pose_file.hpp"

namespace plumb {

/// Lengths in use since 2013-10-03, and those of older papers. Segments of five to a hundred metres
/// show the jitter of the truth.
[[nodiscard]] std::vector<double> new_kitti_lengths_m();  ///< 100, 200 .. 800
[[nodiscard]] std::vector<double> old_kitti_lengths_m();  ///< 5, 10, 50, 100, 150 .. 400

struct MetricOptions {
  std::vector<double> lengths_m = new_kitti_lengths_m();
  int step_frames = 10;  ///< from one segment's first frame to the next one's
};

struct SegmentError {
  int first_frame = 0;
  int last_frame = 0;
  double length_m = 0.0;
  double speed_m_s = 0.0;
  double t_ratio = 0.0;
  double r_rad_m = 0.0;
};

/// @pre gt.size() == est.size(); lengths above zero, step_frames >= 1
[[nodiscard]] std::vector<SegmentError> segment_errors(const std::vector<PoseMatrix>& gt,
                                                       const std::vector<PoseMatrix>& est,
                                                       const MetricOptions& options);

/// Mean errors of some segments in the units that papers print; NaN without segments.
struct MeanError {
  int num_segments = 0;
  double t_percent = 0.0;
  double r_deg_m = 0.0;
};

/// A bin of the tables; `at` is a length [m] or a speed [m/s].
struct BinError {
  double at = 0.0;
  MeanError error;
};

struct MetricSummary {
  MeanError all;
  std::vector<BinError> by_length;  ///< one per length asked for, also where no segment fits
  std::vector<BinError>
      by_speed;  ///< 2, 4 .. 24 m/s, each from 2 below to 2 above; those with segments
};

[[nodiscard]] MetricSummary summarize(const std::vector<SegmentError>& segments,
                                      const std::vector<double>& lengths_m);

/// Path length up to each frame, in single precision like the development kit's.
[[nodiscard]] std::vector<float> path_lengths_m(const std::vector<PoseMatrix>& poses);

/// First frame more than `length_m` further along than `first`, or -1.
[[nodiscard]] int last_frame_of_segment(const std::vector<float>& path_m, int first,
                                        double length_m);

}  // namespace plumb
