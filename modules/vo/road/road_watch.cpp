#include "modules/vo/road/road_watch.hpp"

#include <algorithm>
#include <cmath>

#include "modules/vo/road/running_mean.hpp"

namespace plumb::vo {
namespace {

constexpr double kRatioTime_s = 0.3;
constexpr double kUsualTime_s = 10.0;
constexpr double kUsualTimeOfRoad_s = 3.0;
// Ratios differ by less than this while VO follows the world: the road's speed is known to a few
// per cent, and VO's unit drifts by less than a per cent per second.
constexpr double kMostRunaway = 0.04;
constexpr double kMostRunawayStds = 2.0;  // of the road's speed
// The road's speed and a car's are smooth.
constexpr double kJumpTime_s = 0.5;
constexpr double kMostJump = 0.08;
// Only a road that is seen well now casts doubt: a peak that lags behind a braking car is not.
constexpr double kLeastSupport = 0.4;
constexpr double kDoubted_s = 0.5;
constexpr double kSteady = 0.05;
constexpr double kSteady_s = 5.0;
constexpr double kUnseen_s = 5.0;

}  // namespace

MotionSource RoadWatch::judge(const VoOutput& vo, const RoadSpeedEstimate& road, double dt_s) {
  const double step = vo.T_prev_cam.t.norm();
  const bool compared = road.sure && vo.status == VoStatus::kOk && step > 0.0 && dt_s > 0.0;
  if (compared) follow_ratio(std::log(step / (road.speed * dt_s)), dt_s);
  if (source_ == MotionSource::kFeatures) {
    if (road.sure && road.support > kLeastSupport) doubt_features(vo, road, compared, dt_s);
  } else {
    doubt_road(road.sure, compared, dt_s);
  }
  return source_;
}

void RoadWatch::follow_ratio(double ln_ratio, double dt_s) {
  const double usual_s = source_ == MotionSource::kRoad ? kUsualTimeOfRoad_s : kUsualTime_s;
  if (num_ratios_ > 0) {
    jump_ += weight_of_new(dt_s, kJumpTime_s, num_ratios_ - 1) *
             (std::abs(ln_ratio - last_ratio_) - jump_);
  }
  last_ratio_ = ln_ratio;
  ln_ratio_ += weight_of_new(dt_s, kRatioTime_s, num_ratios_) * (ln_ratio - ln_ratio_);
  usual_ratio_ += weight_of_new(dt_s, usual_s, num_ratios_) * (ln_ratio - usual_ratio_);
  ++num_ratios_;
}

/// @pre the road is seen
void RoadWatch::doubt_features(const VoOutput& vo, const RoadSpeedEstimate& road, bool compared,
                               double dt_s) {
  const double most = kMostRunaway + kMostRunawayStds * road.speed_std / road.speed;
  const bool stands = vo.status == VoStatus::kStandstill || vo.status == VoStatus::kRotationOnly;
  const bool runs_away =
      compared && (jump_ > kMostJump || std::abs(ln_ratio_ - usual_ratio_) > most);
  doubt_s_ = std::max(0.0, doubt_s_ + (stands || runs_away ? dt_s : -dt_s));
  if (doubt_s_ < kDoubted_s) return;
  source_ = MotionSource::kRoad;
  doubt_s_ = steady_s_ = unseen_s_ = 0.0;
  usual_ratio_ = ln_ratio_;
}

void RoadWatch::doubt_road(bool sure, bool compared, double dt_s) {
  unseen_s_ = sure ? 0.0 : unseen_s_ + dt_s;
  const bool steady = compared && jump_ < kMostJump && std::abs(ln_ratio_ - usual_ratio_) < kSteady;
  steady_s_ = steady ? steady_s_ + dt_s : 0.0;
  if (unseen_s_ >= kUnseen_s || steady_s_ >= kSteady_s) reset();
}

double RoadWatch::unit() const { return std::exp(ln_ratio_); }

}  // namespace plumb::vo
