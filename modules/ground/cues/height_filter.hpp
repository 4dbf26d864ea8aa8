/// Kalman filter over the camera's pitch and the heights of the objects that are tracked.
///
/// State    (pitch of this frame, slow pitch, ln height of each object). An object keeps its height,
/// so a car measured
///          while it was near goes on telling the pitch when it is far; errors that objects share
///          through the pitch stay correlated.
/// Memory   kMaxHeights objects and a dense covariance in place, 10 kB.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

namespace plumb {

class HeightFilter {
 public:
  static constexpr std::size_t kMaxHeights = 32;
  static constexpr std::size_t kNone = kMaxHeights;

  struct Prior {
    double mean_pitch_rad = 0.0;
    double pitch_std_rad = 0.0;  ///< of the slow part
    double pitch_time_s = 0.0;
    double log_height_rate_std = 0.0;  ///< [1/sqrt(s)] how much a height may seem to change
  };

  explicit HeightFilter(const Prior& prior);

  /// Slow pitch after `dt_s`, and this frame's pitch unknown again.
  void predict(double dt_s);

  struct Place {
    std::size_t slot = kNone;
    bool is_new = false;
  };
  /// Slot of the track, begun at (mean, variance of ln height) when it is new or changes its class.
  /// kNone when tracks seen at `capture_us` hold all slots; else the one unseen for longest gives
  /// way.
  Place place_of(std::int32_t track_id, std::int8_t object_class, double log_height,
                 double log_height_var, std::int64_t capture_us);
  /// The object's height is unknown again, but for this.
  void restart(std::size_t slot, double log_height, double log_height_var);
  void forget(std::size_t slot);
  /// Forgets every track that was last seen before `oldest_us`.
  void forget_before(std::int64_t oldest_us);

  /// Box: pitch_rad was found with `log_height`; d pitch / d ln height is `J_height`.
  void update_box(std::size_t slot, double log_height, double pitch_rad, double J_height,
                  double var_rad2);
  /// Anything else that measures this frame's pitch.
  void update_pitch(double pitch_rad, double var_rad2);
  /// This frame's pitch is the slow one but for a jitter.
  void tie_to_slow_pitch(double jitter_var_rad2);

  [[nodiscard]] double pitch_rad() const { return x_(kPitch); }
  [[nodiscard]] double pitch_var_rad2() const { return P_(kPitch, kPitch); }
  [[nodiscard]] double slow_pitch_rad() const { return x_(kSlow); }
  [[nodiscard]] double slow_pitch_var_rad2() const { return P_(kSlow, kSlow); }
  [[nodiscard]] double log_height(std::size_t slot) const { return x_(row(slot)); }
  [[nodiscard]] double log_height_var(std::size_t slot) const { return P_(row(slot), row(slot)); }

 private:
  static constexpr int kPitch = 0;
  static constexpr int kSlow = 1;
  static constexpr int kSize = 2 + static_cast<int>(kMaxHeights);
  using State = Eigen::Matrix<double, kSize, 1>;

  struct Slot {
    bool in_use = false;
    std::int32_t track_id = 0;
    std::int8_t object_class = 0;
    std::int64_t seen_us = 0;
  };

  static int row(std::size_t slot) { return 2 + static_cast<int>(slot); }
  /// Scalar measurement h_i x_i + h_j x_j = z.
  void update(int i, double h_i, int j, double h_j, double innovation, double var);
  void decorrelate(int i, double mean, double var);

  Prior prior_;
  State x_ = State::Zero();
  Eigen::Matrix<double, kSize, kSize> P_ = Eigen::Matrix<double, kSize, kSize>::Zero();
  std::array<Slot, kMaxHeights> slots_{};
};

}  // namespace plumb
