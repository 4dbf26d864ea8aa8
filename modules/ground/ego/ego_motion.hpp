/// Metric motion and the integrated pose, from VO's motion and the ground plane's scale.
///
/// A frame whose motion or scale is not known yet is not lost: the pose stays anchored at the last
/// frame that has one, and is carried forward from there, over VO's refined window where it
/// reaches, as soon as both are known.
///
/// Frames  cam: x right, y down, z forward.  world: cam of the first image.  ground: x forward, y
/// left, z up.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "modules/ground/ego/speed_filter.hpp"
#include "modules/ground/types/ground_types.hpp"

namespace plumb {

/// What the plane filter knows of metres per [vo] in this frame.
struct ScaleEstimate {
  bool known = false;
  bool measured_now = false;  ///< a height cue entered this frame
  double log_scale = 0.0;     ///< ln(metres per [vo])
  double var = 0.0;
  double kept_ratio = 1.0;  ///< share of the error before this frame's update that is still in it
};

class EgoMotion {
 public:
  /// Motion of this frame. `normal_cam` gives the ground axes.
  void update(const VoOutput& vo, const ScaleEstimate& scale, const Eigen::Vector3d& normal_cam,
              EgoOutput* out);

 private:
  struct Stamp {
    std::int64_t seq = -1;
    std::int64_t capture_us = 0;
  };

  [[nodiscard]] double interval_s(const VoOutput& vo) const;
  void remember(const VoOutput& vo);
  void follow_anchor(const VoOutput& vo, bool moved);
  void integrate(const VoOutput& vo, const ScaleEstimate& scale, const EgoOutput& out);
  void write_rates(const VoOutput& vo, const Eigen::Vector3d& normal_cam, EgoOutput* out);

  std::array<Stamp, 16> stamps_{};
  std::size_t next_stamp_ = 0;
  std::int64_t last_seq_ = -1;

  // Newest frame with a pose in world, and the way from there to now, [vo].
  bool anchored_ = false;
  std::int64_t anchor_seq_ = -1;
  Se3 T_anchor_cam_;
  bool path_known_ = false;

  Se3 T_world_anchor_;
  Matrix6d cov_world_anchor_ = Matrix6d::Zero();
  // Covariance of the position with the error of log_scale: that error lasts over many frames.
  Eigen::Vector3d cov_position_scale_ = Eigen::Vector3d::Zero();
  double distance_m_ = 0.0;
  std::int32_t reset_counter_ = 0;
  int num_coasted_ = 0;
  SpeedFilter speed_;
};

}  // namespace plumb
