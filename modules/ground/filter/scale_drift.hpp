/// How fast VO's unit drifts, as this drive has shown it, and what that means while no cue sees the
/// road.
///
/// While the road is seen, the filter follows the drift, and ln h tells how far the unit has moved
/// over stretches of time. While it is not, the unit drifts on: the error of ln h grows in
/// proportion to the time, at the rate that is usual in this drive.
///
/// Units:
///   ln h; seconds.
/// Memory:
///   in place.
#pragma once

#include "modules/ground/types/filter_config.hpp"

namespace plumb {

class ScaleDrift {
 public:
  explicit ScaleDrift(const FilterConfig& config = {})
      : config_(config), rate2_(config.held_drift_per_s * config.held_drift_per_s) {}

  /// A cue measured the height `dt_s` after the last image; ln h and its variance are those after
  /// the update.
  void measured(double ln_height, double var, double dt_s);
  /// The camera moved for `dt_s`, and no cue measured the height. Returns the variance that ln h
  /// gains.
  [[nodiscard]] double held(double dt_s);
  /// ln h so far says nothing about ln h from here on: VO began a new unit.
  void change_unit() { began_ = false; }

  /// 1-sigma of d(ln h)/dt.
  [[nodiscard]] double rate_per_s() const;

 private:
  FilterConfig config_;
  double rate2_;
  int num_stretches_ = 0;
  double held_s_ = 0.0;
  // The stretch that is being watched.
  bool began_ = false;
  double stretch_s_ = 0.0;
  double start_ln_height_ = 0.0;
  double start_var_ = 0.0;
};

}  // namespace plumb
