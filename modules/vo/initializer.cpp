#include "modules/vo/initializer.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "core/percentile.hpp"
#include "modules/vo/inverse_depth.hpp"

namespace plumb::vo {
namespace {

// With fewer tracks than these, the reference is given up.
constexpr int kMinTracks = 40;
constexpr double kMinSurvivors = 0.4;  // as a share of the tracks at the reference
// Median flow that is enough when waiting for more would lose the tracks.
constexpr double kUrgentFlowPx = 3.0;
// Median residual of the best rotation, below which there is too little translation.
constexpr double kMinStartParallaxPx = 2.0;
constexpr double kMinStartInlierRatio = 0.5;
constexpr double kStandstillFlowPx = 0.35;
constexpr double kStandstillPercentile = 0.7;
// So many still images in a row prove that the camera stands. Fewer may show one picture
// repeatedly.
constexpr int kProvenStill = 5;
constexpr int kTriangulationIterations = 15;
constexpr int kStartIterations = 30;
// Model of the speed while nothing is measured.
constexpr double kSpeedStdRatio = 0.03;
constexpr double kCarriedAccelerationStd = 1.5;    // [vo]/s^2
constexpr double kAccelerationCorrelationS = 1.0;  // a driver keeps an acceleration this long

/// Returns the standard deviation of ln(speed now / speed when last measured). It grows with the
/// time at first and with its square root later, because accelerations are correlated for a while.
double speed_carry_std(double measured_speed, double unseen_s) {
  const double change_std =
      kCarriedAccelerationStd * unseen_s / std::sqrt(1.0 + unseen_s / kAccelerationCorrelationS);
  return root_sum_square(kSpeedStdRatio, change_std / std::max(measured_speed, 1e-3));
}

/// Returns the pose of the frame before the newest one, or of the newest one if it is alone.
Se3 previous_pose(const LocalMap& map) {
  const Window& window = map.window;
  return window.num_history() > 1 ? window.past_pose(window.history()[1])
                                  : window[window.newest()].T_cam_world;
}

}  // namespace

Initializer::Initializer(const VoConfig& config, const CameraModel& camera, std::uint64_t seed)
    : config_(config), camera_(camera), focal_px_(camera.fx_px, camera.fy_px), random_(seed) {
  const auto capacity = static_cast<std::size_t>(track_capacity(config));
  pairs_.reserve(capacity);
  scratch_.reserve(capacity);
}

void Initializer::begin(const FrameTime& time, LocalMap& map, VoOutput* out) {
  set_reference(time.seq, Se3{}, map.newest_image(), map, out);
  map.keep_image(Se3{});
  out->status = VoStatus::kInitializing;
  out->reason = VoReason::kFirstFrame;
}

void Initializer::begin_anew(const FrameTime& time, LocalMap& map, VoOutput* out) {
  begin(time, map, out);
  restarting_ = true;
  speed_known_ = false;
}

/// Starts tracks in `image` and drops all older frames and tracks.
void Initializer::set_reference(std::int64_t seq, const Se3& T_cam_world, const Pyramid& image,
                                LocalMap& map, VoOutput* out) {
  out->num_new = map.start_reference(seq, T_cam_world, image);
  num_at_reference_ = out->num_new;
  predicted_distance_ = 0.0;
  phase_ = Phase::kTracking;
}

/// Tracks the reference's tracks into the newest image.
void Initializer::track_reference(const FrameTime& time, const Se3& T_predicted, LocalMap& map,
                                  const MotionPredictor& motion, VoOutput* out) {
  map.tracker.begin(map.tracks, time.dt_s);
  if (motion.known()) {
    map.tracker.predict_by_pose(map.tracks, map.window, map.last_image_pose(), T_predicted);
  } else {
    map.tracker.predict_by_flow(map.tracks);
  }
  out->num_tracked = map.tracker.search(map.last_image(), map.newest_image(), map.tracks, true);
  if (motion.known() && out->num_tracked < kMinTracks) {
    // The car no longer moves as it did when it was last seen.
    map.tracker.predict_by_flow(map.tracks);
    out->num_tracked = map.tracker.search(map.last_image(), map.newest_image(), map.tracks, true);
  }
  map.tracker.drop_missing(map.tracks);
  predicted_distance_ += motion.measured_speed() * time.dt_s;
}

void Initializer::update(const FrameTime& time, LocalMap& map, MotionPredictor& motion,
                         VoOutput* out, StageProbe& probe) {
  const Se3 T_predicted = motion.predict(time.dt_s).inverse() * map.last_pose();
  track_reference(time, T_predicted, map, motion, out);
  probe.mark("track");
  const int num_found = out->num_tracked;
  const bool enough = num_found >= std::max(1.0 * kMinTracks, kMinSurvivors * num_at_reference_);
  if (enough && detect_standstill(time, map)) {
    ++num_still_;
    still_s_ += time.dt_s;
    out->status = is_still_proven() ? VoStatus::kStandstill : VoStatus::kInitializing;
    if (!is_still_proven()) out->reason = VoReason::kLowParallax;
    return;
  }
  track_motion(time, T_predicted, map, motion, out, probe);
  num_still_ = 0;
  still_s_ = 0.0;
}

/// Adds the newest image, which has moved, and tries to solve the two views.
void Initializer::track_motion(const FrameTime& time, const Se3& T_predicted, LocalMap& map,
                               MotionPredictor& motion, VoOutput* out, StageProbe& probe) {
  const int num_found = out->num_tracked;
  const bool enough = num_found >= std::max(1.0 * kMinTracks, kMinSurvivors * num_at_reference_);
  // Without a predicted motion, the first search misses near points. Later numbers of tracks are
  // therefore compared with what it found.
  const bool first = map.window.order().size() == 1;
  if (first) num_at_reference_ = num_found;
  if (num_found >= kMinTracks) {
    if (map.window.order().size() == kMaxFrames) {
      map.keyframes.remove_frame(map.window.order()[1], map.tracks, map.window);
    }
    static_cast<void>(map.add_frame(time.seq, T_predicted));
    // When too few tracks are left to continue, this image is the last chance to solve the two
    // views.
    const double min_flow_px = enough ? config_.start_flow_px : kUrgentFlowPx;
    const bool started = try_two_views(time, min_flow_px, map, motion, out);
    probe.mark("start");
    if (started) return;
    if (enough || first) {
      map.keep_image(T_predicted);
      report_unsolved(time, VoReason::kLowParallax, motion, out);
      return;
    }
  }
  set_reference(time.seq, T_predicted, map.newest_image(), map, out);
  map.keep_image(T_predicted);
  report_unsolved(time, VoReason::kTooFewFeatures, motion, out);
}

void Initializer::restart(const FrameTime& time, LocalMap& map, MotionPredictor& motion,
                          VoOutput* out, StageProbe& probe) {
  const Se3 T_image_world = map.last_image_pose();
  const Se3 T_predicted = motion.predict(time.dt_s).inverse() * map.last_pose();
  const bool adjacent = motion.unseen_s() == 0.0;
  restarting_ = true;
  speed_known_ = motion.known();
  const VoReason reason =
      out->num_tracked < kMinTracks ? VoReason::kTooFewFeatures : VoReason::kTooFewInliers;
  if (adjacent) {
    set_reference(time.prev_seq, T_image_world, map.last_image(), map, out);
    map.tracker.begin(map.tracks, time.dt_s);
    map.tracker.predict_by_pose(map.tracks, map.window, T_image_world, T_predicted);
    out->num_tracked = map.tracker.search(map.last_image(), map.newest_image(), map.tracks, true);
    map.tracker.drop_missing(map.tracks);
    predicted_distance_ = motion.measured_speed() * time.dt_s;
    if (out->num_tracked >= kMinTracks) {
      static_cast<void>(map.add_frame(time.seq, T_predicted));
      if (try_two_views(time, config_.start_flow_px, map, motion, out)) return;
    }
  }
  set_reference(time.seq, T_predicted, map.newest_image(), map, out);
  map.keep_image(T_predicted);
  report_unsolved(time, reason, motion, out);
  probe.mark("start");
}

/// Reports that the two views are not solved yet. After a failure of tracking, the motion is
/// predicted for as long as the prediction is valid. At the start it is unknown.
void Initializer::report_unsolved(const FrameTime& time, VoReason reason, MotionPredictor& motion,
                                  VoOutput* out) const {
  out->reason = reason;
  const bool failed = restarting_ && motion.known();
  out->status = failed ? VoStatus::kLost : VoStatus::kInitializing;
  if (!failed) return;
  const PredictedMotion predicted = motion.extrapolate(time.dt_s);
  if (!predicted.valid) return;
  out->status = VoStatus::kCoasting;
  out->cov_prev_cam = predicted.cov;
}

bool Initializer::is_still_proven() const { return num_still_ >= kProvenStill; }

/// Returns whether the camera has not moved since the last frame, and adds the newest image to the
/// history if so.
bool Initializer::detect_standstill(const FrameTime& time, LocalMap& map) {
  const int newest = map.window.newest();
  scratch_.clear();
  for (const int index : map.tracks.active()) {
    const Track& track = map.tracks[index];
    scratch_.push_back((camera_.from_normalized(track.shown_xy_in(newest)) - track.px).norm());
  }
  if (percentile(scratch_, kStandstillPercentile) > kStandstillFlowPx) return false;
  const Se3 T_cam_world = map.window[newest].T_cam_world;
  if (map.window.order().size() == 1) {
    // The alignment with the reference's patches removes the drift that the search accumulates.
    map.tracker.align_to_hosts(map.newest_image().level(0), map.tracks, map.window, T_cam_world);
  }
  map.window.remember(time.seq, T_cam_world, true);
  map.keep_image(T_cam_world);
  return true;
}

/// Collects the pairs of rays in reference and newest image. Returns their median flow in pixels.
double Initializer::collect_pairs(const LocalMap& map) {
  pairs_.clear();
  scratch_.clear();
  for (const int index : map.tracks.active()) {
    const Track& track = map.tracks[index];
    pairs_.push_back({track.host_xy, track.xy});
    scratch_.push_back((track.px - track.host_px).norm());
  }
  return percentile(scratch_, 0.5);
}

/// Solves the two views if the flow is at least `min_flow_px` and not due to a rotation alone.
/// Returns whether the map is initialised.
bool Initializer::try_two_views(const FrameTime& time, double min_flow_px, LocalMap& map,
                                MotionPredictor& motion, VoOutput* out) {
  out->median_flow_px = collect_pairs(map);
  if (out->median_flow_px < min_flow_px) return false;
  if (fit_rotation(pairs_, focal_px_.x(), scratch_).median_px < kMinStartParallaxPx) return false;
  Window& window = map.window;
  const Se3 T_guess =
      window[window.newest()].T_cam_world * window[window.order()[0]].T_cam_world.inverse();
  const TwoView views = solve_two_view(pairs_, focal_px_.x(), T_guess, random_);
  if (!views.ok || views.num_inliers < kMinStartInlierRatio * static_cast<double>(pairs_.size())) {
    return false;
  }
  const bool speed_known = restarting_ && speed_known_ && predicted_distance_ > 0.0;
  build_window(views, speed_known ? predicted_distance_ : typical_distance(views), map, out);
  out->status = VoStatus::kOk;
  if (restarting_) {
    out->reason = VoReason::kRestarted;
    ++out->scale_epoch;
    out->scale_carry_std =
        speed_known ? speed_carry_std(motion.measured_speed(), motion.unseen_s() + time.dt_s)
                    : kNan;
  }
  const Se3 T_now_world = window[window.newest()].T_cam_world;
  // A car that stood has moved a little only by the next image: the still ones were repeated.
  FrameTime since_placed = time;
  if (!is_still_proven()) since_placed.unplaced_s += still_s_;
  if (since_placed.unplaced_s > 0.0) {
    const Se3 T_placed_world = window[window.order()[window.order().size() - 2]].T_cam_world;
    out->cov_prev_cam += map.place_previous(T_placed_world, since_placed);
  }
  if (window.num_history() > 1) {
    motion.observe(previous_pose(map) * T_now_world.inverse(), time.dt_s);
  }
  motion.mark_seen();
  restarting_ = false;
  phase_ = Phase::kDone;
  map.keep_image(T_now_world);
  return true;
}

/// Returns the length of the translation that puts the median track at a typical depth.
double Initializer::typical_distance(const TwoView& views) {
  scratch_.clear();
  for (const RayPair& pair : pairs_) {
    double rho = 0.0;
    if (triangulate(pair, views.T_second_first, &rho)) scratch_.push_back(rho);
  }
  return percentile(scratch_, 0.5) / kTypicalRho;
}

/// Builds the window from the two views: it interpolates the poses between them, triangulates the
/// tracks, refines everything and makes the newest frame a keyframe.
void Initializer::build_window(const TwoView& views, double distance, LocalMap& map,
                               VoOutput* out) {
  Window& window = map.window;
  const auto last = static_cast<double>(window.order().size() - 1);
  const Se3 T_ref_world = window[window.order()[0]].T_cam_world;
  const Eigen::Vector3d rotation = log_so3(views.T_second_first.R);
  for (std::size_t i = 1; i < window.order().size(); ++i) {
    const double fraction = static_cast<double>(i) / last;
    const Se3 T_frame_ref{exp_so3(fraction * rotation),
                          fraction * distance * views.T_second_first.t};
    window[window.order()[i]].T_cam_world = T_frame_ref * T_ref_world;
  }
  const int newest = window.newest();
  map.keyframes.promote(newest, map.newest_image().level(0), map.tracks, window);
  for (const int index : map.tracks.active()) {
    Track& track = map.tracks[index];
    double rho = 0.0;
    const bool valid = triangulate({track.host_xy, track.xy}, views.T_second_first, &rho);
    track.rho = valid ? std::clamp(rho / distance, kMinRho, 1.0) : kTypicalRho;
    track.prior_rho = kTypicalRho;
    track.prior_std = kUnknownRhoStd;
    refine_inverse_depth(track, window, focal_px_, kTriangulationIterations);
  }
  map.retire_gross_outliers(newest);
  map.refine(kStartIterations);
  map.free_outliers();
  map.keyframes.trim_recent(map.tracks, window);
  out->num_inliers = static_cast<int>(map.tracks.active().size());
  const Se3 T_now_world = window[newest].T_cam_world;
  out->cov_prev_cam = motion_covariance(map.fit(T_now_world, 1), previous_pose(map));
  out->is_keyframe = true;
  out->num_new =
      map.keyframes.start_tracks(newest, map.newest_image(), map.attached, map.tracks, window);
}

}  // namespace plumb::vo
