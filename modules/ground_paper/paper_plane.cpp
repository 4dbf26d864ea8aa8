#include "modules/ground_paper/paper_plane.hpp"

#include <algorithm>
#include <cmath>

#include "modules/ground/filter/plane_angles.hpp"

namespace plumb {
namespace {

/// Why the plane was not measured in this frame.
GroundReason reason_held(const PaperFrame& frame, bool started) {
  if (frame.vo_status == VoStatus::kInitializing || frame.vo_status == VoStatus::kCoasting) {
    return GroundReason::kVoNotReady;
  }
  if (frame.vo_status == VoStatus::kStandstill) return GroundReason::kStandstill;
  if (!frame.has_image) return GroundReason::kImageMissing;
  if (started && !frame.measurable) return GroundReason::kLowBaseline;
  return GroundReason::kNoCue;
}

}  // namespace

void write_plane(const PlaneKalman* filter, const PaperFrame& frame, double camera_height_m,
                 PlaneOutput* plane) {
  if (frame.vo_status == VoStatus::kLost) {
    plane->status = GroundStatus::kInvalid;
    plane->reason = GroundReason::kVoLost;
    return;
  }
  if (filter == nullptr) {
    plane->status = GroundStatus::kInitializing;
    plane->reason = reason_held(frame, false);
    return;
  }
  plane->status = frame.measured ? GroundStatus::kOk : GroundStatus::kHeld;
  plane->reason = frame.measured ? GroundReason::kNone : reason_held(frame, true);
  plane->normal_cam = filter->normal();
  plane->pitch_rad = pitch_of(plane->normal_cam);
  plane->roll_rad = roll_of(plane->normal_cam);
  plane->height_m = frame.measured ? frame.height_m : camera_height_m;

  const Eigen::Matrix4d& P = filter->cov();
  Eigen::Matrix2d tilt;
  tilt << P(0, 0), P(0, 2), P(2, 0), P(2, 2);
  const Eigen::Matrix2d J = angles_jacobian(plane->normal_cam);
  plane->cov.setZero();
  plane->cov.topLeftCorner<2, 2>() = J * tilt * J.transpose();
  plane->cov(2, 2) = P(3, 3) / (camera_height_m * camera_height_m) + frame.height_var;
}

ScaleEstimate paper_scale(const PlaneKalman& filter, const PaperFrame& frame, double metres_per_vo,
                          double camera_height_m) {
  ScaleEstimate scale;
  scale.known = true;
  scale.measured_now = frame.measured;
  scale.log_scale = std::log(metres_per_vo);
  const double height_var = filter.cov()(3, 3);
  scale.var = height_var / (camera_height_m * camera_height_m);
  if (frame.var_before > 0.0) {
    scale.kept_ratio = std::clamp(height_var / frame.var_before, 0.0, 1.0);
  }
  return scale;
}

}  // namespace plumb
