#include "modules/integrity/signal_guard.hpp"

#include <cmath>

namespace plumb {

void SignalGuard::reset() { *this = SignalGuard(limits_, recover_images_, reestablish_s_); }

PlausibilityReason SignalGuard::update(double value, double interval_s) {
  was_reestablished_ = false;
  age_s_ += interval_s;
  const bool is_known = !std::isnan(value);
  if (!is_known || value < limits_.low || value > limits_.high) {
    is_doubted_ = true;
    num_reachable_ = 0;
    num_agreeing_ = 0;
    agreeing_s_ = 0.0;
    previous_ = kNan;
    return is_known ? PlausibilityReason::kOutOfRange : PlausibilityReason::kNotMeasured;
  }
  if (is_doubted_) return doubt(value, interval_s);
  if (reachable(value, interval_s)) return believe(value);
  is_doubted_ = true;
  num_reachable_ = 0;
  num_agreeing_ = 0;
  agreeing_s_ = 0.0;
  previous_ = kNan;
  return PlausibilityReason::kTooFast;
}

bool SignalGuard::reachable(double value, double interval_s) const {
  const double unseen_s = age_s_ > interval_s ? age_s_ - interval_s : 0.0;
  double allowed = limits_.slack + limits_.rate * interval_s;
  if (unseen_s > 0.0) allowed += limits_.sustained_rate * unseen_s;
  return std::abs(value - believed_) <= allowed;
}

PlausibilityReason SignalGuard::believe(double value) {
  believed_ = value;
  previous_ = value;
  age_s_ = 0.0;
  is_doubted_ = false;
  return PlausibilityReason::kNone;
}

PlausibilityReason SignalGuard::doubt(double value, double interval_s) {
  const bool has_believed = !std::isnan(believed_);
  const bool agrees = !std::isnan(previous_) &&
                      std::abs(value - previous_) <= limits_.slack + limits_.rate * interval_s;
  num_agreeing_ = agrees ? num_agreeing_ + 1 : 0;
  agreeing_s_ = agrees ? agreeing_s_ + interval_s : 0.0;
  previous_ = value;
  const bool is_reachable = has_believed && reachable(value, interval_s);
  num_reachable_ = is_reachable ? num_reachable_ + 1 : 0;

  if (!has_believed && num_agreeing_ + 1 >= recover_images_) return believe(value);
  if (num_reachable_ >= recover_images_ && num_agreeing_ + 1 >= recover_images_)
    return believe(value);
  if (has_believed && agreeing_s_ >= reestablish_s_ && num_agreeing_ + 1 >= recover_images_) {
    was_reestablished_ = !is_reachable;
    return believe(value);
  }
  return is_reachable || !has_believed ? PlausibilityReason::kRecovering
                                       : PlausibilityReason::kTooFast;
}

}  // namespace plumb
