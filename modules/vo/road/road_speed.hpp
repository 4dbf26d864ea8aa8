/// The speed of the road and the error of the camera's pitch, as a probability over a grid of both
/// (histogram filter; Thrun, Burgard and Fox, "Probabilistic Robotics", section 4.1).
///
/// Each image multiplies the probability by exp(sum over the pairs of images of gain c), with c the
/// normalised correlation of the road at the shift that speed and pitch imply. Between images, the
/// probability spreads by what a road vehicle's speed and pitch can change. Several repeating marks
/// give several peaks, of which the next images leave one.
///
/// Slow speeds are not in the grid: what is attached to the camera, and noise that the lens or the
/// compression fixes to the image, would always speak for them.
///
/// Units:
///   Heights of the camera, seconds, radians.
/// Memory:
///   Two grids, in place.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "modules/vo/road/road_shifts.hpp"

namespace plumb::vo {

/// Two images of the road.
struct RoadPair {
  const RoadShifts* shifts = nullptr;
  double interval_s = 0.0;
};

struct RoadSpeedEstimate {
  bool sure = false;       ///< the other fields are an estimate; else nothing is known
  double speed = 0.0;      ///< [1/s]
  double speed_std = 0.0;  ///< [1/s]
  double support = 0.0;    ///< correlation of the road at the estimate, the less of now and lately
  double pitch_error = 0.0;  ///< y/z of the assumed direction of travel less the true one [rad]
};

class RoadSpeed {
 public:
  RoadSpeed() { reset(); }

  /// Forgets everything.
  void reset();
  /// Takes the pairs that end in the newest image, `dt_s` after the one before.
  void update(std::span<const RoadPair> pairs, double dt_s);
  [[nodiscard]] const RoadSpeedEstimate& estimate() const { return estimate_; }

 private:
  static constexpr std::size_t kNumSpeeds = 125;
  static constexpr std::size_t kNumPitches = 17;
  using Row = std::array<double, kNumSpeeds>;

  void spread_speed(double dt_s);
  void spread_pitch(double dt_s);
  void normalize();
  void locate_peak();
  void follow_support(std::span<const RoadPair> pairs, double dt_s);
  [[nodiscard]] double agreement(std::span<const RoadPair> pairs, std::size_t pitch,
                                 std::size_t speed) const;
  [[nodiscard]] static double speed_of(std::size_t index);
  [[nodiscard]] static double pitch_of(std::size_t index);

  RoadSpeedEstimate estimate_;
  double peak_share_ = 0.0;  // of the probability
  double support_ = 0.0;     // mean correlation at the estimate over the last images
  bool is_supported_ = false;
  std::array<Row, kNumPitches> probability_{};
  std::array<Row, kNumPitches> scratch_{};
};

}  // namespace plumb::vo
