/// Points cue: triangulated road points vote for the camera's height over the road.
///
/// Vote in ln h with a kernel as wide as each pair's depth noise (equation (8) of Song and
/// Chandraker 2014, with per-point widths), then a robust mean. Where the agreeing points lie on
/// average is kept, so that the fusion can weigh height against pitch.
///
/// Frames  cam of the newest image.  Units  [vo].  Memory  kMaxRoadPoints in place.
#pragma once

#include <Eigen/Core>
#include <array>

#include "modules/ground/cues/road_pixels.hpp"
#include "modules/vo/vo.hpp"

namespace plumb {

struct PointsRequest {
  Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();
  double height = 0.0;         ///< expected; 0: not known, any height may win
  double min_ray_slope = 0.0;  ///< y/z below which a point is too near the horizon
  RoadShape road;
};

struct PointsObservation {
  bool ok = false;
  double ln_height = 0.0;                            ///< along the requested normal
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< weighted mean of the agreeing points
  double ln_height_std = 0.0;                        ///< spread of the agreeing points
  double score = 0.0;                                ///< of the winning point
  int num_candidates = 0;
  int num_inliers = 0;
};

class PointsCue {
 public:
  [[nodiscard]] PointsObservation measure(const VoOutput& vo, const PointsRequest& request);

  /// A first guess when nothing is known: most points below the horizon are road, some stand above
  /// it. 0 with too few points.
  [[nodiscard]] double rough_height(const VoOutput& vo, const Eigen::Vector3d& normal_cam);

 private:
  void collect(const VoOutput& vo, const PointsRequest& request);
  [[nodiscard]] int vote(double* best_score) const;
  void average(double ln_start, PointsObservation* out) const;

  int size_ = 0;
  std::array<Eigen::Vector3d, kMaxRoadPoints> points_{};
  alignas(32) std::array<float, kMaxRoadPoints> ln_height_{};
  alignas(32) std::array<float, kMaxRoadPoints> var_{};
};

}  // namespace plumb
