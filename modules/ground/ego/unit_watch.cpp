#include "modules/ground/ego/unit_watch.hpp"

#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

// A jump exceeds the scatter of VO's steps by far, as a share of the speed.
constexpr double kLeastJumpRatio = 0.12;
constexpr double kNumStd = 2.0;
constexpr int kSteadySteps = 3;
// After a longer time, any speed could follow from any other.
constexpr double kLongestSettlingStepS = 0.5;
// Over a longer gap, VO may match points to wrong places.
constexpr double kLongestSureStepS = 0.5;

}  // namespace

UnitVerdict UnitWatch::watch(const VoOutput& vo, double metres_per_vo) {
  const double dt_s = vo.interval_s;
  if (metres_per_vo > 0.0) metres_per_vo_ = metres_per_vo;
  if (vo.scale_carry_std > 0.0) sound_.std_vo_s += vo.scale_carry_std * sound_.vo_s;
  if (std::isnan(vo.scale_carry_std)) sound_.known = false;
  if (vo.scale_carry_std != 0.0) unproven_ = false;  // the step was one of another unit
  const bool measured = vo.status == VoStatus::kOk && dt_s > 0.0;
  if (!measured || !(metres_per_vo_ > 0.0)) {
    return unsettled_ ? UnitVerdict::kUnsettled : UnitVerdict::kSteady;
  }
  const Eigen::Vector3d& t = vo.T_prev_cam.t;
  const Eigen::Vector3d along = t.norm() > 0.0 ? t.normalized() : Eigen::Vector3d::UnitZ();
  const double var = along.dot(vo.cov_prev_cam.topLeftCorner<3, 3>() * along);
  const Speed now{true, vo.capture_us, t.norm() / dt_s, std::sqrt(var) / dt_s};
  return unsettled_ ? settle(now) : compare(vo, now);
}

UnitVerdict UnitWatch::compare(const VoOutput& vo, const Speed& now) {
  const bool confirmed = !unproven_ || follows(last_, now, 0.0);
  unproven_ = false;
  last_ = now;
  if (!confirmed || (sound_.known && !follows(sound_, now, kNumStd))) {
    sound_.known = false;
    unsettled_ = true;
    num_steady_ = 0;
    return UnitVerdict::kJump;
  }
  if (vo.reason == VoReason::kFramesMissing && vo.interval_s > kLongestSureStepS) {
    unproven_ = true;
    return UnitVerdict::kUnproven;
  }
  // A speed that is hardly known would let anything follow it.
  if (now.std_vo_s < kLeastJumpRatio * now.vo_s || !sound_.known) sound_ = now;
  return UnitVerdict::kSteady;
}

double UnitWatch::seconds_between(const Speed& before, const Speed& now) {
  return 1e-6 * static_cast<double>(now.capture_us - before.capture_us);
}

UnitVerdict UnitWatch::settle(const Speed& now) {
  const bool recent = last_.known && seconds_between(last_, now) < kLongestSettlingStepS;
  num_steady_ = recent && follows(last_, now, 0.0) ? num_steady_ + 1 : 0;
  last_ = now;
  if (num_steady_ < kSteadySteps) return UnitVerdict::kUnsettled;
  unsettled_ = false;
  sound_ = now;
  return UnitVerdict::kSteady;
}

/// Whether a vehicle may have changed its speed from `before` to `now`, give or take `num_std`
/// standard deviations.
bool UnitWatch::follows(const Speed& before, const Speed& now, double num_std) const {
  const double passed_s = seconds_between(before, now);
  const double change = now.vo_s - before.vo_s;
  const double most_m_s2 = change > 0.0 ? config_.most_accel_m_s2 : config_.most_brake_m_s2;
  const double scatter = num_std * root_sum_square(before.std_vo_s, now.std_vo_s);
  return std::abs(change) <= most_m_s2 * passed_s / metres_per_vo_ + scatter ||
         std::abs(change) <= kLeastJumpRatio * before.vo_s;
}

}  // namespace plumb
