#include "modules/mount/mount_check.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

constexpr double kLeastSpeed_m_s = 4.0;
// In a turn, a camera ahead of the rear axle also moves sideways: at 10 m/s, 0.02 rad/s changes the
// yaw angle by 0.2 degrees.
constexpr double kStraight_rad_s = 0.02;
constexpr double kEndOfAlarmRatio = 0.5;

MountReason reason_of(const GroundOutput& ground) {
  if (ground.ego.reason == VoReason::kImageUpsideDown) return MountReason::kUpsideDown;
  if (ground.ego.status != EgoStatus::kOk) return MountReason::kNoMotion;
  if (ground.plane.status != GroundStatus::kOk) return MountReason::kNoPlane;
  // A speed that is not measured is NaN.
  if (!(ground.ego.velocity_ground_m_s.norm() >= kLeastSpeed_m_s)) return MountReason::kSlow;
  if (std::abs(ground.ego.rate_ground_rad_s.z()) > kStraight_rad_s) return MountReason::kTurning;
  return MountReason::kNone;
}

}  // namespace

MountCheck::MountCheck(const MountConfig& config) : config_(config) {
  stretches_.fill(Eigen::Vector3d::Zero());
  report_.recent_rad.setConstant(kNan);
  report_.spread_rad.setConstant(kNan);
}

void MountCheck::restore(const MountReference& reference) {
  report_.reference = reference;
  report_.num_stretches = reference.num_stretches;
  report_.progress = 1.0;
  report_.status = status_ = MountStatus::kSteady;
}

const MountReport& MountCheck::update(const GroundOutput& ground) {
  report_.reason = reason_of(ground);
  if (report_.reason != MountReason::kNone) return report_;
  const Eigen::Vector3d& t_m = ground.ego.T_prev_cam.t;
  const double step_m = t_m.norm();
  sum_ += step_m * Eigen::Vector3d(ground.plane.pitch_rad, ground.plane.roll_rad,
                                   std::atan2(t_m.x(), t_m.z()));
  distance_m_ += step_m;
  if (distance_m_ >= config_.stretch_m) end_stretch();
  if (!report_.reference) {
    const double needed = config_.num_stretches;
    const double gathered = static_cast<double>(num_stretches_) + distance_m_ / config_.stretch_m;
    report_.progress = std::min(1.0, gathered / needed);
  }
  return report_;
}

void MountCheck::end_stretch() {
  stretches_[num_stretches_ % kMaxStretches] = sum_ / distance_m_;
  ++num_stretches_;
  sum_.setZero();
  distance_m_ = 0.0;
  const std::size_t num_recent = std::min(num_stretches_, kNumRecent);
  report_.recent_rad = mean(num_recent);
  const auto needed = static_cast<std::size_t>(config_.num_stretches);
  if (num_stretches_ > 1) report_.spread_rad = spread(std::min(num_stretches_, needed));
  if (!report_.reference) {
    report_.num_stretches = static_cast<int>(std::min(num_stretches_, needed));
    if (num_stretches_ >= needed) make_reference();
  } else if (num_recent == kNumRecent) {
    judge();
  }
  report_.status = num_recent == kNumRecent && is_misaligned() ? MountStatus::kMisaligned : status_;
}

/// The plane gives the direction up or down: on a straight road, travel is parallel to it.
bool MountCheck::is_misaligned() const {
  const double off_rad =
      std::max(std::abs(report_.recent_rad.x()), std::abs(report_.recent_rad.z()));
  return off_rad > config_.misaligned_rad;
}

void MountCheck::make_reference() {
  if (report_.spread_rad.maxCoeff() > config_.max_spread_rad) {
    status_ = MountStatus::kUnsteady;
    return;
  }
  const auto count = static_cast<std::size_t>(config_.num_stretches);
  restore({mean(count), report_.spread_rad / std::sqrt(static_cast<double>(count)),
           config_.num_stretches});
}

void MountCheck::judge() {
  const double off_rad = (report_.recent_rad - report_.reference->mean_rad).cwiseAbs().maxCoeff();
  const bool alarmed = status_ == MountStatus::kMoved;
  const double limit_rad = alarmed ? kEndOfAlarmRatio * config_.alarm_rad : config_.alarm_rad;
  status_ = off_rad > limit_rad ? MountStatus::kMoved : MountStatus::kSteady;
}

const Eigen::Vector3d& MountCheck::newest(std::size_t back) const {
  return stretches_[(num_stretches_ - 1 - back) % kMaxStretches];
}

Eigen::Vector3d MountCheck::mean(std::size_t count) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += newest(i);
  return sum / static_cast<double>(count);
}

Eigen::Vector3d MountCheck::spread(std::size_t count) const {
  const Eigen::Vector3d middle = mean(count);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i) sum += (newest(i) - middle).cwiseAbs2();
  return (sum / static_cast<double>(count - 1)).cwiseSqrt();
}

}  // namespace plumb
