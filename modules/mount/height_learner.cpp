#include "modules/mount/height_learner.hpp"

#include <algorithm>
#include <cmath>

#include "modules/ground/cues/robust_mean.hpp"

namespace plumb {
namespace {

constexpr double kLeastVehicleSpeed_m_s = 4.0;
// The body pitches and the camera moves aside when the car turns or brakes.
constexpr double kMostTurn_rad_s = 0.05;
constexpr double kMostAccel_m_s2 = 1.5;
// Two heights that differ by more standard deviations contradict each other.
constexpr double kContradictionStds = 3.0;
// The height in use follows the one that is known at this rate, so that no speed jumps.
constexpr double kMostRate_hz = 0.02;

static_assert(HeightLearner::kMostStretches <= kMaxVotes);

/// A step that tells the height: measured, straight and steady.
bool is_usable(const EgoOutput& ego) {
  const bool turns = !(std::abs(ego.rate_ground_rad_s.z()) <= kMostTurn_rad_s);
  const bool brakes = std::abs(ego.accel_forward_m_s2) > kMostAccel_m_s2;  // false for NaN
  return ego.road_step_heights > 0.0 && !turns && !brakes;
}

CameraHeight height_of(double ln_height, double var) {
  const double height_m = std::exp(ln_height);
  return {height_m, height_m * std::sqrt(var)};
}

}  // namespace

const char* HeightLearner::take_speed(const VehicleSpeed& speed) {
  if (const char* why = track_.take(speed)) return why;
  use_steps();
  return nullptr;
}

const HeightReport& HeightLearner::update(const GroundOutput& ground, const CameraHeight& stated) {
  const std::int64_t now_us = ground.capture_us;
  const std::int64_t interval_us = now_us - last_us_;
  const bool follows = last_us_ != 0 && interval_us > 0 && interval_us <= SpeedTrack::kMostGap_us;
  if (follows && is_usable(ground.ego)) {
    // A full queue drops its oldest step, whose speed did not come in time.
    (void)steps_.push(
        {last_us_, now_us, ground.ego.road_step_heights, ground.ego.road_step_ln_var});
  }
  last_us_ = now_us;
  use_steps();
  take_effect(now_us);
  combine(stated, follows ? 1e-6 * static_cast<double>(interval_us) : 0.0);
  return report_;
}

void HeightLearner::forget() {
  last_us_ = 0;
  steps_.clear();
  ended_.clear();
  heights_ = way_m_ = var_sum_ = 0.0;
  num_stretches_ = 0;
  ln_height_ = var_ = kNan;
  report_ = {};
}

void HeightLearner::use_steps() {
  while (!steps_.empty() && track_.reaches(steps_.front().end_us)) {
    const Step step = steps_.front();
    steps_.drop_front();
    const auto way_m = track_.way_m(step.begin_us, step.end_us);
    const double dt_s = 1e-6 * static_cast<double>(step.end_us - step.begin_us);
    if (way_m && *way_m >= kLeastVehicleSpeed_m_s * dt_s) add(step, *way_m);
  }
}

void HeightLearner::add(const Step& step, double way_m) {
  heights_ += step.heights;
  way_m_ += way_m;
  var_sum_ += way_m * step.ln_var;
  if (way_m_ < config_.height_stretch_m) return;
  (void)ended_.push({std::log(way_m_ / heights_), var_sum_ / way_m_, step.end_us});
  heights_ = way_m_ = var_sum_ = 0.0;
}

/// Takes the stretches that ended long enough ago that their speeds have arrived in any order.
void HeightLearner::take_effect(std::int64_t now_us) {
  bool changed = false;
  while (!ended_.empty() && now_us - ended_.front().end_us >= kDelay_us) {
    stretches_[num_stretches_++ % kMostStretches] = ended_.front();
    ended_.drop_front();
    changed = true;
  }
  if (changed && num_stretches_ >= kLeastStretches) estimate();
}

/// Robust mean of the stretches. Its variance is the larger one of what the stretches state and
/// what they show, and what all stretches share.
void HeightLearner::estimate() {
  const std::size_t count = std::min(num_stretches_, kMostStretches);
  Votes votes;
  for (std::size_t i = 0; i < count; ++i)
    (void)votes.push_back({stretches_[i].ln_height, std::sqrt(stretches_[i].var), 0.0});
  ln_height_ = robust_mean(&votes);
  double weight = 0.0;
  double information = 0.0;
  double scatter = 0.0;
  for (const Vote& vote : votes) {
    weight += vote.weight;
    information += vote.weight / square(vote.std);
    scatter += vote.weight * square(vote.value - ln_height_);
  }
  var_ = std::max(1.0 / information, scatter / square(weight)) + square(config_.height_bias_std) +
         square(track_.newest().scale_std);
}

/// Joins the stated height and the learned one.
void HeightLearner::combine(const CameraHeight& stated, double dt_s) {
  report_.num_stretches = static_cast<int>(std::min(num_stretches_, kMostStretches));
  if (std::isnan(ln_height_)) {
    report_.status = num_stretches_ > 0 ? HeightStatus::kLearning : HeightStatus::kStated;
    report_.used = stated;
    return;
  }
  report_.by_vehicle = height_of(ln_height_, var_);
  double ln_target = std::log(stated.height_m);
  double target_var = stated.var_ratio();
  const double gap = ln_height_ - ln_target;
  const double sum_var = target_var + var_;
  const bool contradicts = square(gap) > square(kContradictionStds) * sum_var;
  report_.status = contradicts ? HeightStatus::kContradicted : HeightStatus::kLearned;
  ln_target += target_var / sum_var * gap;
  target_var *= var_ / sum_var;
  // One of the two is wrong, and this class cannot know which.
  if (contradicts) target_var += 0.25 * square(gap);
  const double most = kMostRate_hz * dt_s;
  const double ln_before = std::log(report_.used.height_m);
  const double ln_used = ln_before + std::clamp(ln_target - ln_before, -most, most);
  report_.used = height_of(ln_used, target_var + square(ln_target - ln_used));
}

}  // namespace plumb
