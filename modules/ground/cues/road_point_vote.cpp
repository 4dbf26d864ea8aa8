#include "modules/ground/cues/road_point_vote.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

// The points may lie nearer and farther than the dense cue's road: each has its own depth noise.
constexpr double kNearRatio = 2.5;
constexpr double kFarRatio = 15.0;
constexpr double kLargestRelStd = 0.2;
constexpr double kSmallestRelStd = 0.02;
constexpr double kLowestRatio = 0.5;  // of the expected height
constexpr double kHighestRatio = 1.8;
constexpr float kRoadRoughnessVar = 0.03F * 0.03F;
constexpr double kMeanRoughnessVar = 0.02 * 0.02;
constexpr double kMeanWindow = 0.1;     // ln h
constexpr double kInlierWindow = 0.06;  // ln h
constexpr int kMeanIterations = 3;
constexpr double kHeightNu = 4.0;
constexpr double kRoughMinRaySlope = 0.085;
constexpr std::size_t kRoughMinPoints = 10;

}  // namespace

PointsMeasurement RoadPointVote::measure(const VoOutput& vo, const VoteRequest& request) {
  PointsMeasurement out;
  collect(vo, request);
  out.num_candidates = size_;
  const int winner = vote(&out.score);
  if (winner < 0) return out;
  average(static_cast<double>(ln_height_[static_cast<std::size_t>(winner)]), &out);
  return out;
}

double RoadPointVote::rough_height(const VoOutput& vo, const Eigen::Vector3d& normal_cam) {
  std::size_t n = 0;
  for (const RoadPoint& point : vo.road_points) {
    const Eigen::Vector3d p = point.p_cam.cast<double>();
    if (p.y() > kRoughMinRaySlope * p.z()) {
      ln_height_[n++] = static_cast<float>(normal_cam.dot(p));
    }
  }
  if (n < kRoughMinPoints) return 0.0;
  const auto begin = ln_height_.begin();
  const auto nth = begin + static_cast<std::ptrdiff_t>(n * 2 / 3);
  std::nth_element(begin, nth, begin + static_cast<std::ptrdiff_t>(n));
  return static_cast<double>(*nth);
}

/// Keeps the points that lie on the path at a plausible height.
void RoadPointVote::collect(const VoOutput& vo, const VoteRequest& request) {
  size_ = 0;
  for (const RoadPoint& point : vo.road_points) {
    const Eigen::Vector3d p = point.p_cam.cast<double>();
    const double height = request.normal_cam.dot(p);
    const double rel_std = static_cast<double>(point.rel_std);
    if (!(height > 0.0) || !(p.y() > request.min_ray_slope * p.z())) continue;
    if (!(rel_std <= kLargestRelStd)) continue;
    const double distance = p.z() / height;
    if (distance < kNearRatio || distance > kFarRatio) continue;
    const double centre = 0.5 * request.road.curvature * p.z() * p.z();
    if (std::abs(p.x() - centre) > request.road.half_width_ratio * height) continue;
    const double ratio = height / request.height;
    if (request.height > 0.0 && (ratio < kLowestRatio || ratio > kHighestRatio)) continue;
    const auto i = static_cast<std::size_t>(size_++);
    const double std = std::max(kSmallestRelStd, rel_std);
    points_[i] = p;
    ln_height_[i] = static_cast<float>(std::log(height));
    var_[i] = static_cast<float>(std * std);
  }
}

/// Returns the index of the point on which most others agree; -1 with fewer than two points. The
/// kernel (1 - e^2/9v)^2 approximates exp(-e^2/2v) without an exponential.
int RoadPointVote::vote(double* best_score) const {
  int winner = -1;
  float best = 0.0F;
  for (int i = 0; i < size_ && size_ > 1; ++i) {
    float score = -1.0F;  // its own vote
    const float ln_height = ln_height_[static_cast<std::size_t>(i)];
    const float var = var_[static_cast<std::size_t>(i)] + kRoadRoughnessVar;
    for (int j = 0; j < size_; ++j) {
      const float e = ln_height - ln_height_[static_cast<std::size_t>(j)];
      const float k = 1.0F - e * e / (9.0F * (var + var_[static_cast<std::size_t>(j)]));
      score += k > 0.0F ? k * k : 0.0F;
    }
    if (score > best) {
      best = score;
      winner = i;
    }
  }
  *best_score = static_cast<double>(best);
  return winner;
}

void RoadPointVote::average(double ln_start, PointsMeasurement* out) const {
  double mean = ln_start;
  for (int iteration = 0; iteration < kMeanIterations; ++iteration) {
    double sum_w = 0.0;
    double sum_ln = 0.0;
    Eigen::Vector3d sum_p = Eigen::Vector3d::Zero();
    for (int j = 0; j < size_; ++j) {
      const auto i = static_cast<std::size_t>(j);
      const double e = static_cast<double>(ln_height_[i]) - mean;
      if (std::abs(e) >= kMeanWindow) continue;
      const double v = static_cast<double>(var_[i]) + kMeanRoughnessVar;
      const double w = 1.0 / (v * (1.0 + e * e / (kHeightNu * v)));
      sum_w += w;
      sum_ln += w * static_cast<double>(ln_height_[i]);
      sum_p += w * points_[i];
    }
    if (!(sum_w > 0.0)) return;
    mean = sum_ln / sum_w;
    out->centre = sum_p / sum_w;
  }
  double square = 0.0;
  for (int j = 0; j < size_; ++j) {
    const double e = static_cast<double>(ln_height_[static_cast<std::size_t>(j)]) - mean;
    if (std::abs(e) >= kInlierWindow) continue;
    ++out->num_inliers;
    square += e * e;
  }
  out->ln_height = mean;
  out->ln_height_std = out->num_inliers > 2 ? std::sqrt(square / out->num_inliers) : 1.0;
  out->ok = out->num_inliers >= 2;
}

}  // namespace plumb
