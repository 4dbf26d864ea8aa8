#include "modules/vo/zero_motion_detector.hpp"

#include "core/percentile.hpp"
#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

// The camera moves when more than one fifth of the tracks do. A median would miss a translation
// that only near points show.
constexpr double kFlowPercentile = 0.8;
constexpr int kRotationIterations = 4;

}  // namespace

ZeroMotionDetector::ZeroMotionDetector(const VoConfig& config, const CameraModel& camera)
    : max_flow_px_(config.hold_flow_px), camera_(camera), focal_px_(camera.fx_px, camera.fy_px) {
  flow_px_.reserve(static_cast<std::size_t>(track_capacity(config)));
}

/// Returns a percentile of the image motion that the active tracks make from the reference to
/// T_to_world. With `compensate_rotation`, only the part that is due to translation counts.
double ZeroMotionDetector::flow_percentile(const LocalMap& map, const Se3& T_to_world,
                                           bool compensate_rotation) {
  const Se3 T_to_ref = T_to_world * T_ref_world_.inverse();
  flow_px_.clear();
  for (const int index : map.tracks.active()) {
    const Track& track = map.tracks[index];
    const Se3 T_ref_host = T_ref_world_ * map.window[track.host].T_cam_world.inverse();
    const Eigen::Vector3d Y = transfer_point(T_ref_host, track.host_xy, track.rho);
    const Eigen::Vector3d Y_turned = T_to_ref.R * Y;
    const Eigen::Vector3d Y_to = Y_turned + track.rho * T_to_ref.t;
    const Eigen::Vector3d& Y_from = compensate_rotation ? Y_turned : Y;
    if (Y_from.z() < kMinDepthRatio || Y_to.z() < kMinDepthRatio) continue;
    flow_px_.push_back((camera_.project(Y_to) - camera_.project(Y_from)).norm());
  }
  return flow_px_.empty() ? 0.0 : percentile(flow_px_, kFlowPercentile);
}

ZeroMotion ZeroMotionDetector::judge(const LocalMap& map, const Se3& T_cam_world) {
  if (!active_) {
    // A predicted pose is no reference, because the camera may have moved differently.
    if (!map.window.history()[0].measured) return ZeroMotion::kNone;
    T_ref_world_ = map.last_pose();
  }
  active_ = !(flow_percentile(map, T_cam_world, true) > max_flow_px_);
  if (!active_) return ZeroMotion::kNone;
  const bool turns = flow_percentile(map, T_cam_world, false) > max_flow_px_;
  return turns ? ZeroMotion::kTranslation : ZeroMotion::kAll;
}

const Se3& ZeroMotionDetector::hold(const LocalMap& map, const Se3& T_cam_world, ZeroMotion kind) {
  if (kind == ZeroMotion::kTranslation) {
    // The start has the fitted rotation and the camera centre c of the reference: t = -R c.
    const Eigen::Vector3d centre = T_ref_world_.inverse().t;
    const Se3 start{T_cam_world.R, -(T_cam_world.R * centre)};
    T_ref_world_ =
        fit_pose(start, map.tracks, map.window, focal_px_, {kRotationIterations, 1.0, true})
            .T_cam_world;
  }
  return T_ref_world_;
}

}  // namespace plumb::vo
