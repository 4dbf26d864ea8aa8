/// Triangulated road points vote for the camera's height over the road.
///
/// The vote is taken in ln h with a kernel as wide as each pair's depth noise: equation (8) of Song
/// and Chandraker (CVPR 2014) with a width for each point. A robust mean follows. The result keeps
/// the mean position of the agreeing points, so that the fusion can weigh height against pitch.
///
/// Frames:
///   cam of the newest image.
/// Units:
///   [vo].
/// Memory:
///   kMaxRoadPoints in place.
#pragma once

#include <Eigen/Core>
#include <array>

#include "modules/ground/cues/road_pixels.hpp"
#include "modules/ground/types/cue_measurements.hpp"
#include "modules/vo/vo.hpp"

namespace plumb {

struct VoteRequest {
  Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();
  double height = 0.0;         ///< expected; 0: not known, and any height may win
  double min_ray_slope = 0.0;  ///< y/z below which a point is too near the horizon
  RoadShape road;
};

class RoadPointVote {
 public:
  [[nodiscard]] PointsMeasurement measure(const VoOutput& vo, const VoteRequest& request);

  /// A rough height when nothing is known: most points below the horizon lie on the road, and the
  /// others above it. 0 with too few points.
  [[nodiscard]] double rough_height(const VoOutput& vo, const Eigen::Vector3d& normal_cam);

 private:
  void collect(const VoOutput& vo, const VoteRequest& request);
  [[nodiscard]] int vote(double* best_score) const;
  void average(double ln_start, PointsMeasurement* out) const;

  int size_ = 0;
  std::array<Eigen::Vector3d, kMaxRoadPoints> points_{};
  alignas(32) std::array<float, kMaxRoadPoints> ln_height_{};
  alignas(32) std::array<float, kMaxRoadPoints> var_{};
};

}  // namespace plumb
