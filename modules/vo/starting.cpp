/// Pipeline's steps from a reference image to the first triangulated window, at the start and after a loss.
#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/vo/inverse_depth.hpp"
#include "modules/vo/pipeline.hpp"

namespace plumb::vo {
namespace {

constexpr int kMinTracks = 40;
constexpr double kMinSurvivors = 0.4;
constexpr double kLeastFlowPx = 3.0;         // when waiting for more would lose the tracks
constexpr double kMinStartParallaxPx = 2.0;  // left by the best rotation
constexpr double kMinStartInlierRatio = 0.5;
constexpr double kStandingFlowPx = 0.35;
constexpr double kStandingShare = 0.7;
constexpr int kDepthIterations = 15;
constexpr int kStartIterations = 30;
constexpr double kSpeedStdRatio = 0.03;
constexpr double kCarriedAccelerationStd = 1.5;  // [vo]/s^2
constexpr double kAccelerationTime = 1.0;  // a driver keeps an acceleration for about this long [s]

/// 1-sigma of ln(speed now / speed when last seen): grows with the time at first, with its root later.
double carried_std(double seen_speed, double unseen_s) {
  const double wander =
      kCarriedAccelerationStd * unseen_s / std::sqrt(1.0 + unseen_s / kAccelerationTime);
  return std::hypot(kSpeedStdRatio, wander / std::max(seen_speed, 1e-3));
}

double at_share(std::vector<double>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

void Pipeline::begin_reference(std::int64_t seq, const Se3& T_cam_world, const Pyramid& from) {
  window_.clear();
  tracks_.clear();
  held_ = false;
  const int slot = window_.add(seq, T_cam_world);
  keyframes_.promote(slot, from.level(0), tracks_, window_);
  out_.num_new = keyframes_.spawn(slot, from, tracks_, window_);
  num_at_reference_ = out_.num_new;
  predicted_distance_ = 0.0;
  mode_ = Mode::kStarting;
}

void Pipeline::start(const VoInput& input, StageProbe& probe) {
  const Se3 T_prev_cam = motion_.predict(dt_s_);
  const Se3 T_predicted = T_prev_cam.inverse() * last_pose();
  tracker_.begin(tracks_, dt_s_);
  if (motion_.known()) {
    tracker_.predict_by_pose(tracks_, window_, last_image_pose(), T_predicted);
  } else {
    tracker_.predict_by_flow(tracks_);
  }
  const int num_found = tracker_.search(last_image(), image(), tracks_, true);
  tracker_.drop_missing(tracks_);
  out_.num_tracked = num_found;
  predicted_distance_ += motion_.seen_speed() * dt_s_;
  probe.mark("track");
  const bool enough = num_found >= std::max(1.0 * kMinTracks, kMinSurvivors * num_at_reference_);
  if (enough && stands_before_start(input)) return;
  // A first search knows no motion and misses what is near: its finds are the measure for those that follow.
  const bool first = window_.order().size() == 1;
  if (first) num_at_reference_ = num_found;
  if (num_found >= kMinTracks) {
    if (window_.order().size() == kMaxFrames) {
      keyframes_.remove_frame(window_.order()[1], tracks_, window_);
    }
    static_cast<void>(add_frame(input.seq, T_predicted));
    // Too few are left to go on: what they tell now, or nothing.
    const bool started = try_start(input, enough ? config_.start_flow_px : kLeastFlowPx);
    probe.mark("start");
    if (started) return;
    if (enough || first) {
      keep_image(T_predicted);
      wait_for_start(input, VoReason::kLowParallax);
      return;
    }
  }
  begin_reference(input.seq, T_predicted, image());
  keep_image(T_predicted);
  wait_for_start(input, VoReason::kTooFewFeatures);
}

// Not started: with a speed from before the loss the motion is predicted, else it is unknown.
void Pipeline::wait_for_start(const VoInput& /*input*/, VoReason reason) {
  out_.reason = reason;
  out_.status = restarting_ ? VoStatus::kLost : VoStatus::kInitializing;
  if (!restarting_) return;
  unseen_s_ += dt_s_;
  if (motion_.known() && unseen_s_ <= config_.coast_limit_s)
    report_prediction(motion_.predict(dt_s_));
}

bool Pipeline::stands_before_start(const VoInput& input) {
  const int newest = window_.newest();
  scratch_.clear();
  for (const int index : tracks_.active()) {
    const Track& track = tracks_[index];
    scratch_.push_back((camera_.from_normalized(track.shown_xy_in(newest)) - track.px).norm());
  }
  if (at_share(scratch_, kStandingShare) > kStandingFlowPx) return false;
  // The view is the reference's own: aligning with its patches undoes the drift of the search.
  const Se3 T_cam_world = window_[newest].T_cam_world;
  if (window_.order().size() == 1) {
    tracker_.anchor(image().level(0), tracks_, window_, T_cam_world);
  }
  window_.remember(input.seq, T_cam_world, true);
  keep_image(T_cam_world);
  out_.status = VoStatus::kStandstill;
  return true;
}

// Pairs of reference and newest view; returns their median flow.
double Pipeline::collect_pairs() {
  pairs_.clear();
  scratch_.clear();
  for (const int index : tracks_.active()) {
    const Track& track = tracks_[index];
    pairs_.push_back({track.host_xy, track.xy});
    scratch_.push_back((track.px - track.host_px).norm());
  }
  return at_share(scratch_, 0.5);
}

bool Pipeline::try_start(const VoInput& /*input*/, double least_flow_px) {
  out_.median_flow_px = collect_pairs();
  if (out_.median_flow_px < least_flow_px) return false;
  if (fit_rotation(pairs_, focal_px_.x(), scratch_).median_px < kMinStartParallaxPx) return false;
  const int reference = window_.order()[0];
  const Se3 T_guess =
      window_[window_.newest()].T_cam_world * window_[reference].T_cam_world.inverse();
  const TwoView views = solve_two_view(pairs_, focal_px_.x(), T_guess, random_);
  if (!views.ok || views.num_inliers < kMinStartInlierRatio * static_cast<double>(pairs_.size())) {
    return false;
  }
  const bool speed_known = restarting_ && speed_known_ && predicted_distance_ > 0.0;
  double distance = predicted_distance_;
  if (!speed_known) {
    scratch_.clear();
    for (const RayPair& pair : pairs_) {
      double rho = 0.0;
      if (triangulate(pair, views.T_second_first, &rho)) scratch_.push_back(rho);
    }
    distance = at_share(scratch_, 0.5) / kTypicalRho;
  }
  adopt_two_views(views, distance);
  out_.status = VoStatus::kOk;
  if (restarting_) {
    out_.reason = VoReason::kRestarted;
    ++out_.scale_epoch;
    out_.scale_carry_std =
        speed_known ? carried_std(motion_.seen_speed(), unseen_s_ + dt_s_) : kNan;
  }
  const Se3 T_now_world = window_[window_.newest()].T_cam_world;
  if (window_.num_history() > 1) {
    motion_.observe(window_.past_pose(window_.history()[1]) * T_now_world.inverse(), dt_s_);
  }
  restarting_ = false;
  unseen_s_ = 0.0;
  mode_ = Mode::kTracking;
  keep_image(T_now_world);
  return true;
}

void Pipeline::adopt_two_views(const TwoView& views, double distance) {
  const auto last = static_cast<double>(window_.order().size() - 1);
  const Se3 T_ref_world = window_[window_.order()[0]].T_cam_world;
  const Eigen::Vector3d turn = log_so3(views.T_second_first.R);
  for (std::size_t i = 1; i < window_.order().size(); ++i) {
    const double share = static_cast<double>(i) / last;
    const Se3 T_frame_ref{exp_so3(share * turn), share * distance * views.T_second_first.t};
    window_[window_.order()[i]].T_cam_world = T_frame_ref * T_ref_world;
  }
  const int newest = window_.newest();
  keyframes_.promote(newest, image().level(0), tracks_, window_);
  for (const int index : tracks_.active()) {
    Track& track = tracks_[index];
    double rho = 0.0;
    const bool meets = triangulate({track.host_xy, track.xy}, views.T_second_first, &rho);
    track.rho = meets ? std::clamp(rho / distance, kMinRho, 1.0) : kTypicalRho;
    track.prior_rho = kTypicalRho;
    track.prior_std = kUnknownRhoStd;
    refine_inverse_depth(track, window_, focal_px_, kDepthIterations);
  }
  drop_gross(newest);
  refiner_.refine(window_, tracks_, focal_px_, config_.fixed_keyframes, kStartIterations);
  drop_outliers();
  keyframes_.trim_recent(tracks_, window_);
  out_.num_inliers = static_cast<int>(tracks_.active().size());
  const Se3 T_now_world = window_[newest].T_cam_world;
  const bool linked = window_.num_history() > 1;
  report_covariance(fit(T_now_world, 1),
                    linked ? window_.past_pose(window_.history()[1]) : T_now_world);
  out_.is_keyframe = true;
  out_.num_new = keyframes_.spawn(newest, image(), tracks_, window_);
}

// Tracking failed: the last image and this one make a new start, with the distance that the speed before predicts.
void Pipeline::restart(const VoInput& input, StageProbe& probe) {
  const Se3 T_image_world = last_image_pose();
  const Se3 T_prev_cam = motion_.predict(dt_s_);
  const Se3 T_predicted = T_prev_cam.inverse() * last_pose();
  const bool adjacent = unseen_s_ == 0.0;
  restarting_ = true;
  speed_known_ = motion_.known();
  const VoReason reason =
      out_.num_tracked < kMinTracks ? VoReason::kTooFewFeatures : VoReason::kTooFewInliers;
  if (adjacent) {
    begin_reference(last_seq_, T_image_world, last_image());
    tracker_.begin(tracks_, dt_s_);
    tracker_.predict_by_pose(tracks_, window_, T_image_world, T_predicted);
    out_.num_tracked = tracker_.search(last_image(), image(), tracks_, true);
    tracker_.drop_missing(tracks_);
    predicted_distance_ = motion_.seen_speed() * dt_s_;
    if (out_.num_tracked >= kMinTracks) {
      static_cast<void>(add_frame(input.seq, T_predicted));
      if (try_start(input, config_.start_flow_px)) return;
    }
  }
  begin_reference(input.seq, T_predicted, image());
  keep_image(T_predicted);
  wait_for_start(input, reason);
  probe.mark("start");
}

}  // namespace plumb::vo
