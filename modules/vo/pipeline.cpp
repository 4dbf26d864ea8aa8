#include "modules/vo/pipeline.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "modules/vo/image_health.hpp"
#include "modules/vo/inverse_depth.hpp"
#include "modules/vo/road_points.hpp"

namespace plumb::vo {
namespace {

constexpr int kNumLevels = 4;
constexpr int kTracksPerActive = 3;  // the pool also holds the passive ones
constexpr double kFoundEnough = 0.6;
constexpr int kMinInliers = 15;
constexpr double kMinInlierRatio = 0.35;
constexpr double kPoorInlierRatio = 0.6;
constexpr double kGrossPx = 4.0;
constexpr double kBadPx = 2.0;
constexpr double kBadNewestPx = 3.0;
constexpr double kSettledDepth = 0.02;  // deviation as a share of rho
constexpr double kMinRefineParallaxPx = 0.3;
constexpr int kKeyframeIterations = 3;
constexpr int kFrameIterations = 1;
// Errors of tracks on one structure are not independent: measured over the Hessian's promise.
constexpr double kCovarianceInflation = 4.0;

}  // namespace

Pipeline::Pipeline(const VoConfig& config, const CameraModel& camera, std::uint64_t seed)
    : config_(config),
      camera_(camera),
      focal_px_(camera.fx_px, camera.fy_px),
      random_(seed),
      pyramids_{Pyramid(camera.width_px, camera.height_px, kNumLevels),
                Pyramid(camera.width_px, camera.height_px, kNumLevels)},
      tracks_(kTracksPerActive * config.max_tracks),
      window_(camera.width_px, camera.height_px),
      tracker_(camera, kTracksPerActive * config.max_tracks),
      keyframes_(config, camera, kTracksPerActive * config.max_tracks),
      refiner_(kTracksPerActive * config.max_tracks) {
  const auto capacity = std::size_t{kTracksPerActive} * static_cast<std::size_t>(config.max_tracks);
  pairs_.reserve(capacity);
  scratch_.reserve(capacity);
}

const VoOutput& Pipeline::update(const VoInput& input, StageProbe& probe) {
  probe.begin();
  if (!accept(input)) return out_;
  const VoReason bad =
      judge_image(input.image, have_image_ ? last_image().level(0) : ImageView{}, config_);
  if (bad == VoReason::kNone) image().build(input.image);
  probe.mark("pyramid");

  if (bad != VoReason::kNone) {
    coast(input, bad);
  } else if (mode_ == Mode::kEmpty) {
    begin_reference(input.seq, Se3{}, image());
    keep_image(Se3{});
    out_.status = VoStatus::kInitializing;
    out_.reason = VoReason::kFirstFrame;
  } else if (mode_ == Mode::kStarting) {
    start(input, probe);
  } else {
    track(input, probe);
  }
  finish(input);
  probe.mark("output");
  return out_;
}

bool Pipeline::accept(const VoInput& input) {
  const std::int32_t epoch = out_.scale_epoch;
  out_ = VoOutput{};
  out_.capture_us = input.capture_us;
  out_.seq = input.seq;
  out_.scale_epoch = epoch;
  if (input.image.empty() || input.image.width_px != camera_.width_px ||
      input.image.height_px != camera_.height_px) {
    out_.reason = VoReason::kNoCalibration;  // none for an image of this size
    return false;
  }
  if (last_seq_ >= 0 && input.capture_us <= last_us_) {
    out_.reason = VoReason::kTimeBackwards;
    return false;
  }
  dt_s_ = last_seq_ >= 0 ? 1e-6 * static_cast<double>(input.capture_us - last_us_) : 0.0;
  if (last_seq_ >= 0 && input.seq != last_seq_ + 1) out_.reason = VoReason::kFramesMissing;
  return true;
}

void Pipeline::track(const VoInput& input, StageProbe& probe) {
  const PoseFit pose = locate(probe);
  report_fit(pose);
  if (pose.num_inliers < kMinInliers || pose.inlier_ratio() < kMinInlierRatio) {
    restart(input, probe);
    return;
  }
  const Hold kind = judge_motion(pose.T_cam_world);
  if (kind != Hold::kNone) {
    hold(input, pose, kind, probe);
    return;
  }
  const Se3 T_image_world = last_image_pose();
  const double since_s = dt_s_ + unseen_s_;
  insert(input, pose.T_cam_world, true, probe);
  const Se3 T_now_world = window_[window_.newest()].T_cam_world;
  const bool follows = unseen_s_ == 0.0 && window_.num_history() > 1;
  const Se3 T_before_world = follows ? window_.past_pose(window_.history()[1]) : T_image_world;
  motion_.observe(T_before_world * T_now_world.inverse(), since_s);
  unseen_s_ = 0.0;
  keep_image(T_now_world);
  out_.status = VoStatus::kOk;
}

PoseFit Pipeline::fit(const Se3& start, int max_iterations) const {
  return fit_pose(start, tracks_, window_, focal_px_, {max_iterations, 1.0, false});
}

PoseFit Pipeline::locate(StageProbe& probe) {
  const Se3 T_predicted = motion_.predict(dt_s_).inverse() * last_pose();
  tracker_.begin(tracks_, dt_s_ + unseen_s_);
  tracker_.predict_by_pose(tracks_, window_, last_image_pose(), T_predicted);
  const auto num_before = static_cast<double>(tracks_.active().size());
  const int num_found = tracker_.search(last_image(), image(), tracks_, unseen_s_ > 0.0);
  if (num_found < kFoundEnough * num_before) search_wider(T_predicted);
  tracker_.drop_missing(tracks_);
  probe.mark("track");

  PoseFit rough = fit(T_predicted, 8);
  if (rough.inlier_ratio() < kPoorInlierRatio) {
    // Far from the prediction: widen the kernel, then close it step by step.
    Se3 T = last_pose();
    for (const double scale : {1000.0, 250.0, 60.0, 15.0, 4.0}) {
      T = fit_pose(T, tracks_, window_, focal_px_, {4, scale, false}).T_cam_world;
    }
    const PoseFit other = fit(T, 8);
    if (other.num_inliers > rough.num_inliers) rough = other;
  }
  probe.mark("pose");
  tracker_.anchor(image().level(0), tracks_, window_, rough.T_cam_world);
  probe.mark("anchor");
  PoseFit pose = fit(rough.T_cam_world, 8);
  probe.mark("pose");
  return pose;
}

// Less and more motion than predicted, for the tracks still missing.
void Pipeline::search_wider(const Se3& T_predicted) {
  const Se3 T_image_world = last_image_pose();
  const Se3 T_image_now = T_image_world * T_predicted.inverse();
  for (const double share : {0.5, 1.5, 0.0}) {
    const Se3 T_image_other{exp_so3(share * log_so3(T_image_now.R)), share * T_image_now.t};
    tracker_.predict_by_pose(tracks_, window_, T_image_world,
                             T_image_other.inverse() * T_image_world);
    const int num_found = tracker_.search(last_image(), image(), tracks_, true);
    if (num_found > kFoundEnough * static_cast<double>(tracks_.active().size())) break;
  }
}

int Pipeline::add_frame(std::int64_t seq, const Se3& T_cam_world) {
  const int slot = window_.add(seq, T_cam_world);
  for (const int index : tracks_.active()) {
    Track& track = tracks_[index];
    track.observe(slot, track.xy, track.row_shift);
    ++track.num_images;
  }
  return slot;
}

void Pipeline::insert(const VoInput& input, const Se3& T_cam_world, bool refine,
                      StageProbe& probe) {
  const int slot = add_frame(input.seq, T_cam_world);
  if (refine) {
    for (const int index : tracks_.active()) {
      Track& track = tracks_[index];
      if (track.rho_std > kSettledDepth * track.rho) {
        refine_inverse_depth(track, window_, focal_px_, 4);
      }
    }
  }
  drop_gross(slot);
  const Keyframes::View view = keyframes_.look(tracks_, window_, T_cam_world);
  const bool keyframe = !refine || keyframes_.wanted(view);
  keyframes_.trim_recent(tracks_, window_);
  if (keyframe) keyframes_.promote(slot, image().level(0), tracks_, window_);
  if (refine && view.median_parallax_px > kMinRefineParallaxPx) {
    refiner_.refine(window_, tracks_, focal_px_, config_.fixed_keyframes,
                    keyframe ? kKeyframeIterations : kFrameIterations);
    drop_outliers();
  }
  probe.mark("refine");
  if (keyframe) {
    out_.num_new = keyframes_.spawn(slot, image(), tracks_, window_);
    probe.mark("detect");
  }
  out_.is_keyframe = keyframe;
  out_.median_parallax_px = view.median_parallax_px;
}

void Pipeline::drop_gross(int slot) {
  tracks_.sift_active([&](int index) {
    Track& track = tracks_[index];
    if (track.host == slot ||
        check_track(track, window_, focal_px_, kBadPx).newest_px <= kGrossPx) {
      return TrackTable::Fate::kStay;
    }
    track.forget(slot);
    return TrackTable::Fate::kRetire;
  });
}

void Pipeline::drop_outliers() {
  const auto good = [this](int index) {
    const TrackFit f = check_track(tracks_[index], window_, focal_px_, kBadPx);
    return f.newest_px <= kBadNewestPx && !(f.num >= 3 && 2 * f.num_bad > f.num);
  };
  tracks_.sift_active(
      [&](int index) { return good(index) ? TrackTable::Fate::kStay : TrackTable::Fate::kFree; });
  tracks_.sift_passive(good);
}

void Pipeline::keep_image(const Se3& T_cam_world) {
  newest_ = 1 - newest_;
  have_image_ = true;
  T_last_image_newest_ = T_cam_world * window_[window_.newest()].T_cam_world.inverse();
}

Se3 Pipeline::last_pose() const { return window_.past_pose(window_.history()[0]); }

Se3 Pipeline::last_image_pose() const {
  return T_last_image_newest_ * window_[window_.newest()].T_cam_world;
}

void Pipeline::report_fit(const PoseFit& pose) {
  out_.num_tracked = pose.num_points;
  out_.num_inliers = pose.num_inliers;
  out_.rms_residual_px = pose.rms_px;
  scratch_.clear();
  for (const int index : tracks_.active()) {
    scratch_.push_back((tracks_[index].px - tracks_[index].prev_px).norm());
  }
  if (!scratch_.empty()) {
    const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / 2);
    std::nth_element(scratch_.begin(), middle, scratch_.end());
    out_.median_flow_px = *middle;
  }
  report_covariance(pose, last_pose());
}

void Pipeline::report_covariance(const PoseFit& pose, const Se3& T_prev_world) {
  // T_prev_cam = T_prev_world T_world_cam: for T_cam_world <- (exp(w), d), t moves by -R_prev_cam d and R by exp(-w)
  // on the right.
  Matrix6d information = pose.information;
  information.diagonal().array() += 1e-9;
  const Matrix6d cov = kCovarianceInflation * information.inverse();
  Matrix6d J = -Matrix6d::Identity();
  J.topLeftCorner<3, 3>() = -(T_prev_world.R * pose.T_cam_world.R.transpose());
  out_.cov_prev_cam = J * cov * J.transpose();
}

void Pipeline::finish(const VoInput& input) {
  if (window_.num_history() > 0) {
    const Se3 T_cam_world = last_pose();
    const bool linked = window_.num_history() > 1 && window_.history()[1].seq == last_seq_;
    if (linked) T_last_world_ = window_.past_pose(window_.history()[1]);
    if (last_seq_ >= 0) {
      out_.prev_seq = last_seq_;
      if (out_.status != VoStatus::kInitializing && out_.status != VoStatus::kLost) {
        out_.T_prev_cam = T_last_world_ * T_cam_world.inverse();
      }
      // What was held is exact, not a difference of equal numbers.
      if (out_.status == VoStatus::kStandstill) out_.T_prev_cam = Se3{};
      if (out_.status == VoStatus::kRotationOnly) out_.T_prev_cam.t.setZero();
    }
    for (int i = 0; i < window_.num_history(); ++i) {
      const Window::Past& past = window_.history()[static_cast<std::size_t>(i)];
      if (!past.seen) continue;
      static_cast<void>(
          out_.window.push_back({past.seq, window_.past_pose(past) * T_cam_world.inverse()}));
    }
    if (mode_ == Mode::kTracking && out_.status != VoStatus::kCoasting &&
        out_.status != VoStatus::kLost) {
      collect_road_points(tracks_, window_, T_cam_world, &out_.road_points);
    }
    T_last_world_ = T_cam_world;
  }
  last_us_ = input.capture_us;
  last_seq_ = input.seq;
}

}  // namespace plumb::vo
