/// Pipeline's steps for a camera that stands still or only turns.
#include <algorithm>
#include <cmath>

#include "modules/vo/pipeline.hpp"
#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

constexpr double kPercentile = 0.8;
constexpr double kMinTracksRatio = 0.6;  // turned away from: new landmarks are needed

}  // namespace

// Image motion that the change of pose from -> to causes, exceeded by a fifth of the tracks.
double Pipeline::flow_percentile(const Se3& T_from_world, const Se3& T_to_world,
                                 bool compensate_rotation) {
  const Se3 T_to_from = T_to_world * T_from_world.inverse();
  scratch_.clear();
  for (const int index : tracks_.active()) {
    const Track& track = tracks_[index];
    const Se3 T_from_host = T_from_world * window_[track.host].T_cam_world.inverse();
    const Eigen::Vector3d Y =
        T_from_host.R * track.host_xy.homogeneous() + track.rho * T_from_host.t;
    const Eigen::Vector3d Y_turned = T_to_from.R * Y;
    const Eigen::Vector3d Y_to = Y_turned + track.rho * T_to_from.t;
    const Eigen::Vector3d& Y_ref = compensate_rotation ? Y_turned : Y;
    if (Y_ref.z() < kMinDepthRatio || Y_to.z() < kMinDepthRatio) continue;
    scratch_.push_back((camera_.project(Y_to) - camera_.project(Y_ref)).norm());
  }
  if (scratch_.empty()) return 0.0;
  const auto at = scratch_.begin() + static_cast<std::ptrdiff_t>(
                                         kPercentile * static_cast<double>(scratch_.size() - 1));
  std::nth_element(scratch_.begin(), at, scratch_.end());
  return *at;
}

// Compared with where holding began, so that creeping adds up until it is seen.
Pipeline::Hold Pipeline::judge_motion(const Se3& T_cam_world) {
  if (!held_) {
    if (!window_.history()[0].seen) return Hold::kNone;
    T_held_world_ = last_pose();
  }
  if (flow_percentile(T_held_world_, T_cam_world, true) > config_.hold_flow_px) {
    held_ = false;
    return Hold::kNone;
  }
  held_ = true;
  const bool turns = flow_percentile(T_held_world_, T_cam_world, false) > config_.hold_flow_px;
  return turns ? Hold::kTranslation : Hold::kAll;
}

void Pipeline::hold(const VoInput& input, const PoseFit& pose, Hold kind, StageProbe& probe) {
  if (kind == Hold::kTranslation) {
    // The centre stays: t = -R c with the centre c of the held pose.
    const Eigen::Vector3d centre = T_held_world_.inverse().t;
    const Se3 start{pose.T_cam_world.R, -(pose.T_cam_world.R * centre)};
    T_held_world_ = fit_pose(start, tracks_, window_, focal_px_, {4, 1.0, true}).T_cam_world;
  }
  const double num_tracks = static_cast<double>(tracks_.active().size());
  const bool thin = num_tracks < kMinTracksRatio * keyframes_.num_at_keyframe();
  const Se3 T_prev_cam = last_pose() * T_held_world_.inverse();
  if (kind == Hold::kTranslation && thin) {
    insert(input, T_held_world_, false, probe);
  } else {
    window_.remember(input.seq, T_held_world_, true);
  }
  motion_.observe({T_prev_cam.R, Eigen::Vector3d::Zero()}, dt_s_);
  unseen_s_ = 0.0;
  keep_image(T_held_world_);
  out_.status = kind == Hold::kAll ? VoStatus::kStandstill : VoStatus::kRotationOnly;
}

}  // namespace plumb::vo
