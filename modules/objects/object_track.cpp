#include "modules/objects/object_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/numbers.hpp"
#include "modules/objects/object_prediction.hpp"
#include "modules/objects/object_prior.hpp"

namespace plumb {
namespace {

/// A heading that is tried for a new object, and -2 ln of its prior probability.
struct Heading {
  double yaw_rad;
  double cost;
};
constexpr std::array<Heading, 4> kHeadings{{{0.0, 0.0},
                                            {0.5 * std::numbers::pi, 4.0},
                                            {0.25 * std::numbers::pi, 5.0},
                                            {-0.25 * std::numbers::pi, 5.0}}};

constexpr double kMisfitChi2 = 30.0;  ///< gate of the four edges
constexpr int kMostMisfits = 3;       ///< consecutive misfits that restart a track

/// [m/s] Added to the velocity when its reference changes between the road and the camera.
constexpr double kUnknownMotionSpeedStd = 8.0;
constexpr double kDistanceErrorRatio = 0.02;  ///< error of the camera's motion over a frame

// The velocity determines the heading when it is above both limits.
constexpr double kLeastSpeed_m_s = 2.0;
constexpr double kLeastSpeedSigmas = 4.0;
constexpr double kCrabStd = 0.06;  ///< [rad] of the heading against the direction of motion

// The errors of consecutive boxes are correlated, so their evidence fades and is limited.
constexpr double kOddsTime_s = 10.0;
constexpr double kEvidenceRate = 10.0;  ///< [1/s] largest change of the log odds

// A stationary filter this unlikely is initialised again when the moving one is this slow.
constexpr double kReseedLogOdds = -6.0;
constexpr double kReseedSigmas2 = 6.0;
constexpr double kReseedSpeedStd = 3.0;  ///< [m/s] of a moving filter that is initialised again

}  // namespace

bool ObjectTrack::start(const TrackView& view, const Detection& detection, const MeasuredBox& box) {
  object_class_ = detection.object_class;
  num_misfits_ = 0;
  num_other_class_ = 0;
  was_whole_ = is_whole(box);
  bool found = false;
  double least = 0.0;
  for (const Heading& heading : kHeadings) {
    const BoxFitResult fit =
        fit_box(view.camera, view.plane, contact_of(view.objects, object_class_), box,
                prior_of(view, detection, box, heading.yaw_rad));
    const double cost = fit.cost + heading.cost;
    if (!fit.ok || fit.estimate.x(kX) <= 0.0 || (found && cost >= least)) continue;
    least = cost;
    moving_ = fit.estimate;
    heading_rad_ = heading.yaw_rad;
    found = true;
  }
  if (!found) return false;
  fresh_ = true;
  init_stationary();
  mix();
  return true;
}

void ObjectTrack::init_stationary() {
  stationary_ = moving_;
  stationary_log_odds_ = 0.0;
  since_update_s_ = 0.0;
  Eigen::Matrix2d S = moving_.P.block<2, 2>(kVelocityX, kVelocityX);
  S.diagonal().array() += square(kStationarySpeedStd_m_s);
  const Eigen::Matrix<double, kStateSize, 2> K = moving_.P.middleCols<2>(kVelocityX) * S.inverse();
  stationary_.x -= K * moving_.x.segment<2>(kVelocityX);
  stationary_.P -= K * S * K.transpose();
  set_stationary(&stationary_);
}

void ObjectTrack::predict(const TrackView& view, const GroundMotion& motion) {
  const double dt_s = motion.dt_s;
  AxesStep axes;
  if (motion.known) {
    const double c = std::cos(motion.yaw_rad), s = std::sin(motion.yaw_rad);
    axes.R_new_old << c, s, -s, c;
    axes.t_m = motion.t_m;
    axes.yaw_rad = motion.yaw_rad;
  }
  predict_state(view, axes, dt_s, heading_rad_, &moving_);
  add_acceleration(
      square(motion.known ? view.objects.accel_std_m_s2 : view.objects.relative_accel_std_m_s2),
      dt_s, &moving_);
  if (motion.known != over_ground_ && !fresh_) {
    moving_.P.block<2, 2>(kVelocityX, kVelocityX).diagonal().array() +=
        square(kUnknownMotionSpeedStd);
    init_stationary();
  } else {
    predict_state(view, axes, dt_s, heading_rad_, &stationary_);
    set_stationary(&stationary_);
    stationary_.P.topLeftCorner<2, 2>().diagonal().array() +=
        square(kDistanceErrorRatio) * motion.t_m.squaredNorm();
    stationary_log_odds_ *= std::exp(-dt_s / kOddsTime_s);
  }
  over_ground_ = motion.known;
  fresh_ = false;
  since_update_s_ += dt_s;
  mix();
}

void ObjectTrack::mix() {
  estimate_ = moving_;
  if (!over_ground_) return;
  const double share = 1.0 / (1.0 + std::exp(-stationary_log_odds_));
  StateVector difference = stationary_.x - moving_.x;
  // A stationary object does not show which end is its front.
  difference(kYaw) = 0.5 * wrapped(2.0 * difference(kYaw));
  estimate_.x += share * difference;
  estimate_.x(kYaw) = wrapped(estimate_.x(kYaw));
  estimate_.P = (1.0 - share) * moving_.P + share * stationary_.P +
                share * (1.0 - share) * (difference * difference.transpose());
}

bool ObjectTrack::update_hypotheses(const BoxFitResult& moving, const BoxFitResult& stationary) {
  const bool moves = moving.ok && moving.chi2 <= kMisfitChi2;
  const bool stands = over_ground_ && stationary.ok && stationary.chi2 <= kMisfitChi2;
  const double most_evidence = kEvidenceRate * since_update_s_;
  since_update_s_ = 0.0;
  if (moves) moving_ = moving.estimate;
  if (stands) stationary_ = stationary.estimate;
  if (moves && stands) {
    const double evidence =
        0.5 * (moving.chi2 + moving.log_det - stationary.chi2 - stationary.log_det);
    stationary_log_odds_ += std::clamp(evidence, -most_evidence, most_evidence);
  } else if (stands) {
    stationary_log_odds_ += most_evidence;
    moving_ = stationary_;
    moving_.P.block<2, 2>(kVelocityX, kVelocityX).diagonal().array() += square(kReseedSpeedStd);
  } else if (moves) {
    stationary_log_odds_ = std::min(stationary_log_odds_, kReseedLogOdds);
  }
  if (moves && stationary_log_odds_ <= kReseedLogOdds) {
    const Eigen::Vector2d v = moving_.x.segment<2>(kVelocityX);
    const Eigen::Matrix2d P = moving_.P.block<2, 2>(kVelocityX, kVelocityX);
    if (v.dot(P.inverse() * v) < kReseedSigmas2) init_stationary();
  }
  return moves || stands;
}

bool ObjectTrack::correct(const TrackView& view, const Detection& detection,
                          const MeasuredBox& box) {
  // A box that the image cuts does not determine the heading, so the track restarts with every box
  // until it had a whole one.
  if (!was_whole_) return start(view, detection, box);
  // A class that the detector changes for a single frame is ignored.
  num_other_class_ = detection.object_class == object_class_ ? 0 : num_other_class_ + 1;
  if (num_other_class_ >= kMostMisfits) return start(view, detection, box);
  const Contact contact = contact_of(view.objects, object_class_);
  const BoxFitResult moving = fit_box(view.camera, view.plane, contact, box, moving_);
  const BoxFitResult stationary =
      over_ground_ ? fit_box(view.camera, view.plane, contact, box, stationary_) : BoxFitResult{};
  if (!update_hypotheses(moving, stationary)) {
    if (++num_misfits_ < kMostMisfits) return false;
    return start(view, detection, box);
  }
  num_misfits_ = 0;
  align_with_motion();
  mix();
  return true;
}

void ObjectTrack::align_with_motion() {
  if (!over_ground_) return;
  const Eigen::Vector2d v = moving_.x.segment<2>(kVelocityX);
  const double speed = v.norm();
  const double speed_var = moving_.P.block<2, 2>(kVelocityX, kVelocityX).trace();
  if (speed < kLeastSpeed_m_s || speed < kLeastSpeedSigmas * std::sqrt(speed_var)) return;
  // The outline is the same for two opposite headings; the motion decides between them.
  double off_rad = wrapped(std::atan2(v.y(), v.x()) - moving_.x(kYaw));
  if (std::abs(off_rad) > 0.5 * std::numbers::pi) {
    moving_.x(kYaw) = wrapped(moving_.x(kYaw) + std::numbers::pi);
    heading_rad_ = wrapped(heading_rad_ + std::numbers::pi);
    off_rad = wrapped(off_rad + std::numbers::pi);
  }
  StateVector H = StateVector::Zero();
  H(kYaw) = 1.0;
  H(kVelocityX) = v.y() / square(speed);
  H(kVelocityY) = -v.x() / square(speed);
  const StateVector PH = moving_.P * H;
  const StateVector K = PH / (H.dot(PH) + square(kCrabStd));
  moving_.x += K * off_rad;
  moving_.x(kYaw) = wrapped(moving_.x(kYaw));
  moving_.P -= K * PH.transpose();
}

}  // namespace plumb
