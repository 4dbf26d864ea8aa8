#include "modules/ground/plane_report.hpp"

#include <cmath>

#include "modules/ground/filter/plane_angles.hpp"

namespace plumb {
namespace {

/// Why the plane was not measured in this frame.
GroundReason reason_held(const PlaneEvidence& evidence) {
  if (evidence.vo_status == VoStatus::kInitializing || evidence.vo_status == VoStatus::kCoasting) {
    return GroundReason::kVoNotReady;
  }
  if (evidence.vo_status == VoStatus::kStandstill) return GroundReason::kStandstill;
  if (!evidence.has_image) return GroundReason::kImageMissing;
  if (!evidence.measurable) return GroundReason::kLowBaseline;
  return evidence.height_rejected ? GroundReason::kCuesRejected : GroundReason::kNoCue;
}

void write_height(const PlaneFilter& filter, const PlaneEvidence& evidence, PlaneOutput* plane) {
  const double ln_height_here = filter.state()(2);
  const double camera_height_m = evidence.camera_height.height_m;
  if (!evidence.height_measured) {
    plane->height_m = camera_height_m * std::exp(filter.ahead()(2) - ln_height_here);
    plane->cov(2, 2) = filter.cov()(2, 2) + filter.ahead_var(Eigen::RowVector3d::UnitZ());
  } else {
    const HeightMeasurement& seen = evidence.height_seen;
    plane->height_m = camera_height_m * std::exp(seen.ln_height - ln_height_here);
    plane->cov(2, 2) = seen.var + filter.ahead_var({seen.slope(0), seen.slope(1), 0.0});
  }
  plane->cov(2, 2) += evidence.added.ln_height;
  plane->cov(2, 2) += evidence.camera_height.var_ratio();
}

}  // namespace

void write_plane(const PlaneFilter& filter, const PlaneEvidence& evidence, PlaneOutput* plane) {
  if (evidence.vo_status == VoStatus::kLost) {
    plane->status = GroundStatus::kInvalid;
    plane->reason = GroundReason::kVoLost;
    return;
  }
  if (!filter.started()) {
    plane->status = GroundStatus::kInitializing;
    plane->reason = reason_held(evidence);
    return;
  }
  const bool measured = evidence.height_measured;
  plane->status = measured ? GroundStatus::kOk : GroundStatus::kHeld;
  plane->reason = measured && evidence.has_image ? GroundReason::kNone : reason_held(evidence);
  plane->normal_cam = normal_of_state(filter.ahead());
  plane->pitch_rad = pitch_of(plane->normal_cam);
  plane->roll_rad = roll_of(plane->normal_cam);

  plane->cov.setZero();
  const Eigen::Matrix2d J = angles_jacobian(plane->normal_cam);
  plane->cov.topLeftCorner<2, 2>() = J * filter.ahead_cov().topLeftCorner<2, 2>() * J.transpose();
  plane->cov(0, 0) += evidence.added.pitch_rad2;
  plane->cov(1, 1) += evidence.added.roll_rad2;
  write_height(filter, evidence, plane);
}

}  // namespace plumb
