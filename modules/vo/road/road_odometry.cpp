#include "modules/vo/road/road_odometry.hpp"

#include <cmath>

#include "core/numbers.hpp"

namespace plumb::vo {
namespace {

// What the posterior of the speed does not know: 0.1 degrees of pitch, the slope of the road ahead
// and the lens.
constexpr double kLeastSpeedStd = 0.05;
// What is known less of a road that is newly seen: a peak may be the wrong one of repeating marks,
// and the direction of travel one of traffic. In dense traffic, 25 % were seen.
constexpr double kNewSpeedStd = 0.2;
constexpr double kNewTime_s = 1.0;
// Standard deviation of the direction of travel [rad].
constexpr double kDirectionStd = 0.01;

bool has_rotation(const VoOutput& vo) {
  return vo.status != VoStatus::kInitializing && vo.status != VoStatus::kLost;
}

}  // namespace

void RoadOdometry::reset() {
  motion_.reset();
  watch_.reset();
  poses_.clear();
  sees_road_ = false;
  sure_s_ = 0.0;
}

void RoadOdometry::update(const ImageView& image, bool usable, double dt_s, VoOutput* vo) {
  if (usable && has_rotation(*vo)) {
    motion_.take(image, *vo, watch_.source() == MotionSource::kFeatures, dt_s);
  } else {
    motion_.miss(dt_s);
  }
  const RoadSpeedEstimate& road = motion_.estimate();
  sees_road_ = usable && road.sure;
  sure_s_ = road.sure ? sure_s_ + dt_s : 0.0;
  const MotionSource before = watch_.source();
  const MotionSource source = watch_.judge(*vo, road, dt_s);
  if (source == MotionSource::kRoad && before != source) {
    unit_ = watch_.unit();
    poses_.clear();
  }
  number_epoch(before, vo);
  if (source == MotionSource::kRoad) {
    replace(road, usable, dt_s, vo);
  } else if (sees_road_ && vo->status == VoStatus::kOk && watch_.knows_unit()) {
    state_height(watch_.unit(), road, vo);
  }
}

double RoadOdometry::speed_std_ratio(const RoadSpeedEstimate& road) const {
  const double newness = kNewSpeedStd * std::exp(-sure_s_ / kNewTime_s);
  return root_sum_square(kLeastSpeedStd, road.speed_std / road.speed, newness);
}

void RoadOdometry::state_height(double unit, const RoadSpeedEstimate& road, VoOutput* vo) const {
  vo->road_height = unit;
  vo->road_height_std = speed_std_ratio(road) * unit;
}

/// Counts the units of VO and the changes between VO and the road.
void RoadOdometry::number_epoch(MotionSource before, VoOutput* vo) {
  const bool is_new_unit = vo->scale_epoch != features_epoch_;
  features_epoch_ = vo->scale_epoch;
  const bool is_new_source = watch_.source() != before;
  const bool follows_features = watch_.source() == MotionSource::kFeatures;
  if (is_new_source || (is_new_unit && follows_features)) ++epoch_;
  vo->scale_epoch = epoch_;
  if (is_new_source) {
    vo->scale_carry_std = kNan;
  } else if (!follows_features) {
    vo->scale_carry_std = 0.0;
  }
}

void RoadOdometry::replace(const RoadSpeedEstimate& road, bool usable, double dt_s, VoOutput* vo) {
  // Why an image could not be used, or not be placed, says more than where the motion comes from.
  if (usable && has_rotation(*vo)) vo->reason = VoReason::kRoadMotion;
  vo->road_points.clear();
  vo->window.clear();
  if (!road.sure || !has_rotation(*vo)) {
    vo->status = VoStatus::kLost;
    vo->T_prev_cam = Se3{};
    poses_.clear();
    return;
  }
  const double step = unit_ * road.speed * dt_s;
  const Eigen::Vector3d ahead = motion_.direction().homogeneous().normalized();
  const double step_std = speed_std_ratio(road) * step;
  vo->status = usable ? VoStatus::kOk : VoStatus::kCoasting;
  vo->T_prev_cam.t = step * ahead;
  vo->cov_prev_cam.topRightCorner<3, 3>().setZero();
  vo->cov_prev_cam.bottomLeftCorner<3, 3>().setZero();
  vo->cov_prev_cam.topLeftCorner<3, 3>() =
      square(kDirectionStd * step) * Eigen::Matrix3d::Identity() +
      square(step_std) * ahead * ahead.transpose();
  state_height(unit_, road, vo);
  replace_window(vo);
}

void RoadOdometry::replace_window(VoOutput* vo) {
  const Pose newest{vo->seq, poses_.empty() ? Se3{} : poses_[0].T_start_cam * vo->T_prev_cam};
  FixedVector<Pose, kMaxWindowPoses> poses;
  (void)poses.push_back(newest);
  for (const Pose& pose : poses_) (void)poses.push_back(pose);
  poses_ = poses;
  for (const Pose& pose : poses_)
    (void)vo->window.push_back({pose.seq, pose.T_start_cam.inverse() * newest.T_start_cam});
}

}  // namespace plumb::vo
