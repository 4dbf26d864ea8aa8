#include "tools/evaluate/eval/kitti_metric.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

constexpr double kFramePeriod_s = 0.1;

double rotation_angle_rad(const PoseMatrix& T) {
  const double cosine = 0.5 * (T(0, 0) + T(1, 1) + T(2, 2) - 1.0);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

template <typename Keep>
MeanError mean_of(const std::vector<SegmentError>& segments, Keep keep) {
  MeanError mean;
  double t_sum = 0.0;
  double r_sum = 0.0;
  for (const SegmentError& segment : segments) {
    if (!keep(segment)) continue;
    ++mean.num_segments;
    t_sum += segment.t_ratio;
    r_sum += segment.r_rad_m;
  }
  const double n = mean.num_segments;
  mean.t_percent = n > 0.0 ? 100.0 * t_sum / n : kNan;
  mean.r_deg_m = n > 0.0 ? degrees(r_sum / n) : kNan;
  return mean;
}

SegmentError segment_error(const std::vector<PoseMatrix>& gt, const std::vector<PoseMatrix>& est,
                           int first_frame, int last_frame, double length_m) {
  const auto first = static_cast<std::size_t>(first_frame);
  const auto last = static_cast<std::size_t>(last_frame);
  const PoseMatrix T_first_last_gt = gt[first].inverse() * gt[last];
  const PoseMatrix T_first_last_est = est[first].inverse() * est[last];
  const PoseMatrix error = T_first_last_est.inverse() * T_first_last_gt;
  SegmentError result;
  result.first_frame = first_frame;
  result.last_frame = last_frame;
  result.length_m = length_m;
  result.speed_m_s = length_m / (kFramePeriod_s * (last_frame - first_frame + 1));
  result.t_ratio = error.topRightCorner<3, 1>().norm() / length_m;
  result.r_rad_m = rotation_angle_rad(error) / length_m;
  return result;
}

}  // namespace

std::vector<double> new_kitti_lengths_m() { return {100, 200, 300, 400, 500, 600, 700, 800}; }

std::vector<double> old_kitti_lengths_m() { return {5, 10, 50, 100, 150, 200, 250, 300, 350, 400}; }

std::vector<float> path_lengths_m(const std::vector<PoseMatrix>& poses) {
  std::vector<float> path_m(poses.size(), 0.0F);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Vector3f step_m = (poses[i - 1] - poses[i]).topRightCorner<3, 1>().cast<float>();
    path_m[i] = path_m[i - 1] + step_m.norm();
  }
  return path_m;
}

int last_frame_of_segment(const std::vector<float>& path_m, int first, double length_m) {
  const auto begin = path_m.begin() + first;
  const float end_m = *begin + static_cast<float>(length_m);
  const auto last = std::find_if(begin, path_m.end(), [end_m](float m) { return m > end_m; });
  return last == path_m.end() ? -1 : static_cast<int>(last - path_m.begin());
}

std::vector<SegmentError> segment_errors(const std::vector<PoseMatrix>& gt,
                                         const std::vector<PoseMatrix>& est,
                                         const MetricOptions& options) {
  std::vector<SegmentError> segments;
  const std::vector<float> path_m = path_lengths_m(gt);
  for (int first = 0; first < static_cast<int>(gt.size()); first += options.step_frames) {
    for (const double length_m : options.lengths_m) {
      const int last = last_frame_of_segment(path_m, first, length_m);
      if (last >= 0) segments.push_back(segment_error(gt, est, first, last, length_m));
    }
  }
  return segments;
}

MetricSummary summarize(const std::vector<SegmentError>& segments,
                        const std::vector<double>& lengths_m) {
  MetricSummary summary;
  summary.all = mean_of(segments, [](const SegmentError&) { return true; });
  for (const double length_m : lengths_m) {
    const auto keep = [length_m](const SegmentError& s) { return s.length_m == length_m; };
    summary.by_length.push_back({length_m, mean_of(segments, keep)});
  }
  for (double speed_m_s = 2.0; speed_m_s < 25.0; speed_m_s += 2.0) {
    const auto keep = [speed_m_s](const SegmentError& s) {
      return std::abs(s.speed_m_s - speed_m_s) < 2.0;
    };
    const BinError bin{speed_m_s, mean_of(segments, keep)};
    if (bin.error.num_segments > 0) summary.by_speed.push_back(bin);
  }
  return summary;
}

}  // namespace plumb
