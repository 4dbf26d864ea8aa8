#include "modules/ground/filter/scale_drift.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

constexpr double kStretchS = 2.0;
// The rate is the mean over about this many stretches; the setting counts as one.
constexpr int kRememberedStretches = 8;

}  // namespace

void ScaleDrift::measured(double ln_height, double var, double dt_s) {
  held_s_ = 0.0;
  stretch_s_ += dt_s;
  if (began_ && stretch_s_ < kStretchS) return;
  if (began_) {
    // What ln h moved by, without what its own errors explain.
    const double moved2 = std::max(0.0, square(ln_height - start_ln_height_) - var - start_var_);
    num_stretches_ = std::min(num_stretches_ + 1, kRememberedStretches);
    rate2_ += (moved2 / square(stretch_s_) - rate2_) / (num_stretches_ + 1);
  }
  began_ = true;
  stretch_s_ = 0.0;
  start_ln_height_ = ln_height;
  start_var_ = var;
}

double ScaleDrift::held(double dt_s) {
  const double before_s = held_s_;
  held_s_ += dt_s;
  stretch_s_ += dt_s;
  return rate2_ * (square(held_s_) - square(before_s));
}

double ScaleDrift::rate_per_s() const { return std::sqrt(rate2_); }

}  // namespace plumb
