#include "modules/vo/zero_motion_detector.hpp"

#include "core/percentile.hpp"
#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

constexpr double kFlowShare = 0.8;

}  // namespace

ZeroMotionDetector::ZeroMotionDetector(const VoConfig& config, const CameraModel& camera)
    : max_flow_px_(config.hold_flow_px), camera_(camera), focal_px_(camera.fx_px, camera.fy_px) {
  flow_px_.reserve(static_cast<std::size_t>(track_capacity(config)));
}

/// Image motion from the held pose to T_to_world that a fifth of the active tracks exceed.
double ZeroMotionDetector::flow_percentile(const LocalMap& map, const Se3& T_to_world,
                                           bool compensate_rotation) {
  const Se3 T_to_from = T_to_world * T_held_world_.inverse();
  flow_px_.clear();
  for (const int index : map.tracks.active()) {
    const Track& track = map.tracks[index];
    const Se3 T_from_host = T_held_world_ * map.window[track.host].T_cam_world.inverse();
    const Eigen::Vector3d Y =
        T_from_host.R * track.host_xy.homogeneous() + track.rho * T_from_host.t;
    const Eigen::Vector3d Y_turned = T_to_from.R * Y;
    const Eigen::Vector3d Y_to = Y_turned + track.rho * T_to_from.t;
    const Eigen::Vector3d& Y_ref = compensate_rotation ? Y_turned : Y;
    if (Y_ref.z() < kMinDepthRatio || Y_to.z() < kMinDepthRatio) continue;
    flow_px_.push_back((camera_.project(Y_to) - camera_.project(Y_ref)).norm());
  }
  return flow_px_.empty() ? 0.0 : percentile(flow_px_, kFlowShare);
}

ZeroMotion ZeroMotionDetector::judge(const LocalMap& map, const Se3& T_cam_world) {
  if (!active_) {
    // A predicted pose is no reference: the camera may have moved otherwise.
    if (!map.window.history()[0].seen) return ZeroMotion::kNone;
    T_held_world_ = map.last_pose();
  }
  active_ = !(flow_percentile(map, T_cam_world, true) > max_flow_px_);
  if (!active_) return ZeroMotion::kNone;
  const bool turns = flow_percentile(map, T_cam_world, false) > max_flow_px_;
  return turns ? ZeroMotion::kTranslation : ZeroMotion::kAll;
}

const Se3& ZeroMotionDetector::hold(const LocalMap& map, const Se3& T_cam_world, ZeroMotion kind) {
  if (kind == ZeroMotion::kTranslation) {
    // The centre c of the held pose stays: t = -R c.
    const Eigen::Vector3d centre = T_held_world_.inverse().t;
    const Se3 start{T_cam_world.R, -(T_cam_world.R * centre)};
    T_held_world_ = fit_pose(start, map.tracks, map.window, focal_px_, {4, 1.0, true}).T_cam_world;
  }
  return T_held_world_;
}

}  // namespace plumb::vo
