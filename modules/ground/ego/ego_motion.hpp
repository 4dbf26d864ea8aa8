/// Metric motion and the integrated pose, from VO's motion and the ground plane's scale.
///
/// Velocity and rates need the interval that VO vouches for, and are NaN without it.
///
/// Frames whose motion or scale is not known yet are not lost. The pose stays anchored at the last
/// frame that has one. As soon as both are known it is carried forward from the anchor, over VO's
/// refined window as far as that reaches.
///
/// Frames  cam: x right, y down, z forward.  world: cam of the first image.
///         ground: x forward, y left, z up.
/// Units   metres, unless [vo] says otherwise.
/// Memory  in place.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "modules/ground/ego/speed_filter.hpp"
#include "modules/ground/ego/step_scatter.hpp"
#include "modules/ground/types/ground_types.hpp"

namespace plumb {

/// Metres per [vo] in one frame, as the plane filter estimates them.
struct ScaleEstimate {
  bool known = false;
  bool measured_now = false;  ///< a cue measured the height in this frame
  double log_scale = 0.0;     ///< ln(metres per [vo])
  double var = 0.0;
  double kept_ratio = 1.0;  ///< share of the error before this frame's update that remains
};

class EgoMotion {
 public:
  explicit EgoMotion(const EgoConfig& config = {})
      : config_(config), speed_(config), scatter_(config) {}

  /// Writes the motion of this frame. `normal_cam` gives the ground axes.
  void update(const VoOutput& vo, const ScaleEstimate& scale, const Eigen::Vector3d& normal_cam,
              EgoOutput* out);

 private:
  [[nodiscard]] Matrix6d motion_cov(const VoOutput& vo, double metres_per_vo) const;
  void add_coasting(const VoOutput& vo, double step_m, Matrix6d* cov);
  void follow_anchor(const VoOutput& vo, bool moved);
  void integrate(const VoOutput& vo, const ScaleEstimate& scale, const EgoOutput& out);
  void write_rates(const VoOutput& vo, const ScaleEstimate& scale,
                   const Eigen::Vector3d& normal_cam, EgoOutput* out);
  [[nodiscard]] double scatter_factor(const VoOutput& vo, double speed_m_s, double speed_var);

  EgoConfig config_;
  std::int64_t last_seq_ = -1;

  // Newest frame with a pose in world, and the motion from there to now, [vo].
  bool anchored_ = false;
  std::int64_t anchor_seq_ = -1;
  Se3 T_anchor_cam_;
  bool path_known_ = false;

  Se3 T_world_anchor_;
  Matrix6d cov_world_anchor_ = Matrix6d::Zero();
  // Covariance of the position with the error of log_scale, which lasts over many frames.
  Eigen::Vector3d cov_position_scale_ = Eigen::Vector3d::Zero();
  double distance_m_ = 0.0;
  std::int32_t reset_counter_ = 0;
  int num_coasted_ = 0;
  Matrix6d cov_coasted_ = Matrix6d::Zero();  ///< what the predicted steps added
  SpeedFilter speed_;
  StepScatter scatter_;
};

}  // namespace plumb
