#include "modules/vo/pipeline.hpp"

#include <algorithm>

#include "core/percentile.hpp"
#include "modules/vo/features.hpp"
#include "modules/vo/image_health.hpp"
#include "modules/vo/inverse_depth.hpp"
#include "modules/vo/road_points.hpp"

namespace plumb::vo {
namespace {

constexpr double kFoundEnough = 0.6;  // share of the tracks below which the search is widened
// With fewer inliers than these, tracking has failed.
constexpr int kMinInliers = 15;
constexpr double kMinInlierRatio = 0.35;
// Below this share of inliers, the fit is tried again from farther away.
constexpr double kPoorInlierRatio = 0.6;
// Below this share of the keyframe's tracks, the camera has turned away from its landmarks.
constexpr double kMinTurnedTracksRatio = 0.6;
constexpr int kPoseIterations = 8;
constexpr int kAnnealingIterations = 4;
// A track that may be attached must have been seen in so many images.
constexpr int kMinAttachedImages = 5;
// Inverse depth by which the epipolar line is begun, and the slope of a ray below the horizon under
// which a road that passes is seen to move.
constexpr double kSmallRho = 1e-3;
constexpr double kNearRoadSlope = 0.1;

}  // namespace

Pipeline::Pipeline(const VoConfig& config, const CameraModel& camera, std::uint64_t seed)
    : config_(config),
      camera_(camera),
      map_(config, camera),
      motion_(config),
      zero_motion_(config, camera),
      initializer_(config, camera, seed),
      orientation_(static_cast<std::size_t>(track_capacity(config))),
      road_(camera) {
  scratch_.reserve(static_cast<std::size_t>(track_capacity(config)));
}

const VoOutput& Pipeline::update(const VoInput& input, StageProbe& probe) {
  probe.begin();
  if (!accept(input)) return out_;
  const VoReason bad =
      input.unusable != VoReason::kNone ? input.unusable : judge_image(input.image, config_);
  if (bad == VoReason::kNone) map_.newest_image().build(input.image);
  probe.mark("pyramid");

  if (input.is_discontinuous) {
    break_off();
    road_.reset();
  }
  if (bad != VoReason::kNone) {
    coast(bad);
  } else if (is_broken_off_) {
    is_broken_off_ = false;
    initializer_.begin_anew(time_, map_, &out_);
  } else if (is_map_doubted_) {
    is_map_doubted_ = false;
    initializer_.restart(time_, map_, motion_, &out_, probe);
  } else if (!initializer_.has_reference()) {
    initializer_.begin(time_, map_, &out_);
  } else if (!initializer_.done()) {
    initializer_.update(time_, map_, motion_, &out_, probe);
  } else {
    track(probe);
  }
  report(input);
  map_epoch_ = out_.scale_epoch;
  road_.update(input.image, bad == VoReason::kNone, time_.dt_s, &out_);
  probe.mark("road");
  judge_orientation();
  if (bad == VoReason::kNone) report_features();
  probe.mark("output");
  return out_;
}

/// Returns whether the image has the camera's size. Clears out_ and sets time_.
bool Pipeline::accept(const VoInput& input) {
  const std::int32_t published_epoch = out_.scale_epoch;
  out_ = VoOutput{};
  out_.capture_us = input.capture_us;
  out_.seq = input.seq;
  out_.scale_epoch = published_epoch;
  if (input.image.empty() || input.image.width_px != camera_.width_px ||
      input.image.height_px != camera_.height_px) {
    out_.reason = VoReason::kNoCalibration;  // the calibration is of another size
    return false;
  }
  out_.scale_epoch = map_epoch_;
  const bool first = last_seq_ < 0;
  time_ = {input.seq, last_seq_, first ? 0.0 : input.interval_s, unplaced_s_};
  unplaced_s_ = 0.0;
  if (!first && input.seq != last_seq_ + 1) out_.reason = VoReason::kFramesMissing;
  return true;
}

/// Drops what is known of the motion. The next usable image begins a new map.
void Pipeline::break_off() {
  motion_.forget();
  zero_motion_.reset();
  coasted_cov_.setZero();
  orientation_.reset();
  is_broken_off_ = initializer_.has_reference();
  is_map_doubted_ = false;
}

/// Handles an image that shows nothing. The motion is predicted and fades.
void Pipeline::coast(VoReason reason) {
  out_.reason = reason;
  out_.status = VoStatus::kLost;
  if (!initializer_.has_reference()) return;
  // The torn region may lag behind from now on, and the map would bend between the two.
  is_map_doubted_ |= reason == VoReason::kImageTorn;
  const PredictedMotion predicted = motion_.coast(time_.dt_s);
  initializer_.add_predicted_distance(motion_.measured_speed() * time_.dt_s);
  zero_motion_.reset();
  map_.window.remember(time_.seq, predicted.T_prev_cam.inverse() * map_.last_pose(), false);
  if (!predicted.valid) {
    unplaced_s_ = time_.unplaced_s + time_.dt_s;
    return;
  }
  out_.status = VoStatus::kCoasting;
  out_.cov_prev_cam = predicted.cov;
  coasted_cov_ += predicted.cov;
}

/// Localises the newest image in the map and updates the map with it.
void Pipeline::track(StageProbe& probe) {
  const PoseFit pose = localize(probe);
  report_fit(pose);
  // The outliers are still among the tracks.
  collect_features(map_.tracks, map_.window, pose.T_cam_world, camera_, &out_.features);
  if (pose.num_inliers < kMinInliers || pose.inlier_ratio() < kMinInlierRatio) {
    zero_motion_.reset();
    initializer_.restart(time_, map_, motion_, &out_, probe);
    return;
  }
  observe_attached(pose.T_cam_world);
  const ZeroMotion kind = zero_motion_.judge(map_, pose.T_cam_world);
  if (kind == ZeroMotion::kNone) {
    handle_motion(pose, probe);
  } else {
    handle_zero_motion(pose, kind, probe);
  }
}

/// Shows the tracks to the judge of what is attached to the camera, and frees those that are. A
/// track is held against every depth from infinity on: its place in its host's image, turned by the
/// camera's rotation, and from there on along the epipolar line.
void Pipeline::observe_attached(const Se3& T_cam_world) {
  const auto T_cam_slot = map_.window.slots_to_cam(T_cam_world);
  for (const int index : map_.tracks.active()) {
    const Track& track = map_.tracks[index];
    if (track.num_images < kMinAttachedImages) continue;
    const Se3& T_cam_host = T_cam_slot[static_cast<std::size_t>(track.host)];
    const Eigen::Vector3d ray = T_cam_host.R * track.host_xy.homogeneous();
    if (!(ray.z() > 0.0)) continue;
    const Eigen::Vector2d far_px = camera_.project(ray);
    const Eigen::Vector2d along =
        (camera_.project(ray + kSmallRho * T_cam_host.t) - far_px).stableNormalized();
    const Eigen::Vector2d e = track.px - far_px;
    TrackMotion motion;
    motion.px = track.px;
    motion.moved_px = (track.px - track.host_px).norm();
    motion.off_px = (e - std::max(0.0, e.dot(along)) * along).norm();
    motion.must_move = road_.sees_road() && track.xy.y() - road_.horizon_y() > kNearRoadSlope;
    map_.attached.add(motion);
  }
  map_.attached.end_image(time_.dt_s);
  map_.tracks.sift_active([this](int index) {
    return map_.attached.covers(map_.tracks[index].px) ? TrackTable::Fate::kFree
                                                       : TrackTable::Fate::kStay;
  });
}

/// Searches the tracks in the newest image and fits its pose to them. The first fit gives the
/// motion by which the host patches are warped; the second one uses the positions that they give.
PoseFit Pipeline::localize(StageProbe& probe) {
  const Se3 T_predicted = motion_.predict(time_.dt_s).inverse() * map_.last_pose();
  map_.tracker.begin(map_.tracks, time_.dt_s + motion_.unseen_s());
  map_.tracker.predict_by_pose(map_.tracks, map_.window, map_.last_image_pose(), T_predicted);
  const auto num_before = static_cast<double>(map_.tracks.active().size());
  const int num_found = map_.tracker.search(map_.last_image(), map_.newest_image(), map_.tracks,
                                            motion_.unseen_s() > 0.0);
  if (num_found < kFoundEnough * num_before) search_wider(T_predicted);
  map_.tracker.drop_missing(map_.tracks);
  probe.mark("track");
  const PoseFit rough = fit_from(T_predicted);
  probe.mark("pose");
  map_.tracker.align_to_hosts(map_.newest_image().level(0), map_.tracks, map_.window,
                              rough.T_cam_world);
  probe.mark("anchor");
  PoseFit pose = map_.fit(rough.T_cam_world, kPoseIterations);
  probe.mark("pose");
  return pose;
}

/// Searches the missing tracks again, with less and with more motion than predicted.
void Pipeline::search_wider(const Se3& T_predicted) {
  const Se3 T_image_world = map_.last_image_pose();
  const Se3 T_image_now = T_image_world * T_predicted.inverse();
  for (const double factor : {0.5, 1.5, 0.0}) {
    const Se3 T_image_other{exp_so3(factor * log_so3(T_image_now.R)), factor * T_image_now.t};
    map_.tracker.predict_by_pose(map_.tracks, map_.window, T_image_world,
                                 T_image_other.inverse() * T_image_world);
    const int num_found =
        map_.tracker.search(map_.last_image(), map_.newest_image(), map_.tracks, true);
    if (num_found > kFoundEnough * static_cast<double>(map_.tracks.active().size())) break;
  }
}

/// Fits the pose to the tracks as the search left them. When the prediction is poor, a second fit
/// starts with a wide robust kernel and narrows it step by step (graduated non-convexity). The fit
/// with more inliers wins.
PoseFit Pipeline::fit_from(const Se3& T_predicted) const {
  PoseFit near = map_.fit(T_predicted, kPoseIterations);
  if (near.inlier_ratio() >= kPoorInlierRatio) return near;
  const Eigen::Vector2d focal_px(camera_.fx_px, camera_.fy_px);
  Se3 T = map_.last_pose();
  for (const double scale : {1000.0, 250.0, 60.0, 15.0, 4.0}) {
    T = fit_pose(T, map_.tracks, map_.window, focal_px, {kAnnealingIterations, scale, false})
            .T_cam_world;
  }
  const PoseFit far = map_.fit(T, kPoseIterations);
  return far.num_inliers > near.num_inliers ? far : near;
}

/// The camera has translated. The frame enters the window, and the motion is measured.
void Pipeline::handle_motion(const PoseFit& pose, StageProbe& probe) {
  const Window& window = map_.window;
  const Se3 T_image_world = map_.last_image_pose();
  const double since_s = time_.dt_s + motion_.unseen_s();
  const bool seen_before = motion_.unseen_s() == 0.0;
  insert(pose.T_cam_world, true, probe);
  const Se3 T_now_world = window[window.newest()].T_cam_world;
  const bool follows = seen_before && window.num_history() > 1;
  const Se3 T_before_world = follows ? window.past_pose(window.history()[1]) : T_image_world;
  motion_.observe(T_before_world * T_now_world.inverse(), since_s);
  if (time_.unplaced_s > 0.0) {
    out_.cov_prev_cam += map_.place_previous(T_image_world, time_);
  }
  map_.keep_image(T_now_world);
  out_.status = VoStatus::kOk;
}

/// The camera stands still or turns on the spot, and its position stays as it was. The frame enters
/// the window only if the camera has turned away from most of its landmarks.
void Pipeline::handle_zero_motion(const PoseFit& pose, ZeroMotion kind, StageProbe& probe) {
  const Se3& T_held_world = zero_motion_.hold(map_, pose.T_cam_world, kind);
  const auto num_tracks = static_cast<double>(map_.tracks.active().size());
  const bool turned_away = num_tracks < kMinTurnedTracksRatio * map_.keyframes.num_at_keyframe();
  const Se3 T_prev_cam = map_.last_pose() * T_held_world.inverse();
  if (kind == ZeroMotion::kTranslation && turned_away) {
    insert(T_held_world, false, probe);
  } else {
    map_.window.remember(time_.seq, T_held_world, true);
  }
  motion_.observe({T_prev_cam.R, Eigen::Vector3d::Zero()}, time_.dt_s);
  map_.keep_image(T_held_world);
  out_.status = kind == ZeroMotion::kAll ? VoStatus::kStandstill : VoStatus::kRotationOnly;
}

/// Adds the frame to the map and reports what became of it.
void Pipeline::insert(const Se3& T_cam_world, bool refine, StageProbe& probe) {
  const Insertion done = map_.insert(time_.seq, T_cam_world, refine, probe);
  out_.num_new = done.num_new;
  out_.is_keyframe = done.is_keyframe;
  out_.median_parallax_px = done.median_parallax_px;
}

void Pipeline::report_fit(const PoseFit& pose) {
  out_.num_tracked = pose.num_points;
  out_.num_inliers = pose.num_inliers;
  out_.rms_residual_px = pose.rms_px;
  scratch_.clear();
  for (const int index : map_.tracks.active()) {
    scratch_.push_back((map_.tracks[index].px - map_.tracks[index].prev_px).norm());
  }
  if (!scratch_.empty()) out_.median_flow_px = upper_median(scratch_);
  out_.cov_prev_cam = motion_covariance(pose, map_.last_pose());
  // The motion from a predicted pose to a measured one makes up for the error of the prediction.
  out_.cov_prev_cam += coasted_cov_;
  coasted_cov_.setZero();
}

/// Reports motion, window and road points, from the poses as they are refined now.
void Pipeline::report(const VoInput& input) {
  const Window& window = map_.window;
  out_.attached_share = map_.attached.share();
  if (window.num_history() > 0) {
    const Se3 T_cam_world = map_.last_pose();
    report_motion(T_cam_world);
    for (int i = 0; i < window.num_history(); ++i) {
      const PastFrame& past = window.history()[static_cast<std::size_t>(i)];
      if (!past.measured) continue;
      static_cast<void>(
          out_.window.push_back({past.seq, window.past_pose(past) * T_cam_world.inverse()}));
    }
    if (initializer_.done() && out_.status != VoStatus::kCoasting &&
        out_.status != VoStatus::kLost) {
      collect_road_points(map_.tracks, window, T_cam_world, &out_.road_points);
    }
    T_last_world_ = T_cam_world;
  }
  last_seq_ = input.seq;
}

/// Reports the motion since the previous image.
void Pipeline::report_motion(const Se3& T_cam_world) {
  const Window& window = map_.window;
  const bool linked = window.num_history() > 1 && window.history()[1].seq == last_seq_;
  if (linked) T_last_world_ = window.past_pose(window.history()[1]);
  if (last_seq_ < 0) return;
  out_.prev_seq = last_seq_;
  if (out_.status != VoStatus::kInitializing && out_.status != VoStatus::kLost) {
    out_.T_prev_cam = T_last_world_ * T_cam_world.inverse();
  }
  // Zero motion is reported as exact zeros, not as the difference of two equal poses.
  if (out_.status == VoStatus::kStandstill) out_.T_prev_cam = Se3{};
  if (out_.status == VoStatus::kRotationOnly) out_.T_prev_cam.t.setZero();
}

/// Upside down, the motion has wrong signs and the plane is none. Then nothing is reported as
/// valid, while tracking goes on. When the camera has been turned, a new map begins, with a unit of
/// its own, so that nothing that was found upside down is used any more. When it was upright all
/// the time, as the road shows, the map goes on.
void Pipeline::judge_orientation() {
  if (out_.scale_epoch != oriented_epoch_) orientation_.loosen();
  oriented_epoch_ = out_.scale_epoch;
  const bool was_upside_down = orientation_.verdict() == Orientation::kUpsideDown;
  if (road_.sees_road()) {
    orientation_.see_road();
  } else if (out_.status == VoStatus::kOk && out_.reason != VoReason::kRoadMotion) {
    observe_orientation();
  }
  const Orientation now = orientation_.verdict();
  if (was_upside_down && now != Orientation::kUpsideDown && !road_.sees_road()) break_off();
  if (out_.status == VoStatus::kLost) return;
  if (now == Orientation::kUpsideDown) {
    out_.status = VoStatus::kLost;
    out_.reason = VoReason::kImageUpsideDown;
    out_.T_prev_cam = Se3{};
    out_.road_points.clear();
    out_.road_height = out_.road_height_std = kNan;
  } else if (now == Orientation::kUnproven) {
    out_.reason = VoReason::kOrientationUnproven;
    // Where neither road nor houses are seen, what does not move may drive along.
    if (out_.status != VoStatus::kOk && out_.status != VoStatus::kCoasting)
      out_.status = VoStatus::kInitializing;
  }
}

/// Adds new features, and the middles of cells that are attached to the camera, where none is
/// tracked any more. No other kind is known while the motion is not, or is not the features'.
void Pipeline::report_features() {
  const bool knows_motion = (out_.status == VoStatus::kOk || out_.status == VoStatus::kStandstill ||
                             out_.status == VoStatus::kRotationOnly) &&
                            out_.reason != VoReason::kRoadMotion;
  if (!knows_motion) out_.features.clear();
  const auto num_new = static_cast<std::size_t>(out_.num_new);
  const std::size_t num_active = map_.tracks.active().size();
  add_undecided_features(map_.tracks, out_.features.empty() ? num_active : num_new, &out_.features);
  map_.attached.for_each([this](const Eigen::Vector2i& first_px) {
    const Eigen::Vector2f middle_px =
        first_px.cast<float>().array() + 0.5F * static_cast<float>(AttachedRegions::kCellPx);
    static_cast<void>(out_.features.push_back({middle_px, FeatureKind::kAttached}));
  });
}

/// Shows the tracks to the judge of the orientation. The direction of travel is that over the whole
/// window, over which the car's pitching averages out.
void Pipeline::observe_orientation() {
  if (out_.window.empty()) return;
  const Window& window = map_.window;
  const Se3 T_cam_world = map_.last_pose();
  const Se3& T_window_cam = out_.window[out_.window.size() - 1].T_window_cam;
  orientation_.begin(T_window_cam.R.transpose() * T_window_cam.t);
  const auto T_cam_slot = window.slots_to_cam(T_cam_world);
  for (const int index : map_.tracks.active()) {
    const Track& track = map_.tracks[index];
    const Se3& T_cam_host = T_cam_slot[static_cast<std::size_t>(track.host)];
    double rho = 0.0;
    double rho_std = 0.0;
    if (inverse_depth_in(track, T_cam_host, &rho, &rho_std)) {
      orientation_.add(track.xy, rho, rho_std);
    }
  }
  orientation_.end();
}

}  // namespace plumb::vo
