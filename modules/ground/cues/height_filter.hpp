/// Kalman filter of the camera's pitch and the heights of the tracked objects.
///
/// State:
///   The pitch of this frame, the slow pitch, and ln height of each object. An object keeps its
///   height, so that a car that was measured while it was near still measures the pitch when it is
///   far. Errors that objects share through the pitch stay correlated.
/// Memory:
///   kMaxHeights objects and a dense covariance in place, 10 kB.
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
    double log_height_rate_std = 0.0;  ///< [1/sqrt(s)] random walk of ln height
  };

  explicit HeightFilter(const Prior& prior);

  /// Predicts the slow pitch over `dt_s` and makes this frame's pitch unknown again.
  void predict(double dt_s);

  struct Place {
    std::size_t slot = kNone;
    bool is_new = false;
  };
  /// Slot of the track. A track that is new or has changed its class gets the given ln height. When
  /// all slots are taken, the track that was unseen for longest is dropped; kNone when all of them
  /// were seen at `capture_us`.
  Place place_of(std::int32_t track_id, std::int8_t object_class, double log_height,
                 double log_height_var, std::int64_t capture_us);
  /// Resets the object's height to this value.
  void reset_height(std::size_t slot, double log_height, double log_height_var);
  void drop(std::size_t slot);
  /// Drops every track that was last seen before `oldest_us`.
  void drop_before(std::int64_t oldest_us);

  /// Takes a box whose pitch was read with `log_height`; `J_height` is d pitch / d ln height.
  void update_box(std::size_t slot, double log_height, double pitch_rad, double J_height,
                  double var_rad2);
  /// Takes another measurement of this frame's pitch.
  void update_pitch(double pitch_rad, double var_rad2);
  /// States that this frame's pitch is the slow one plus jitter.
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
  /// Fuses a scalar measurement h_i x_i + h_j x_j = z.
  void update(int i, double h_i, int j, double h_j, double innovation, double var);
  void decorrelate(int i, double mean, double var);

  Prior prior_;
  State x_ = State::Zero();
  Eigen::Matrix<double, kSize, kSize> P_ = Eigen::Matrix<double, kSize, kSize>::Zero();
  std::array<Slot, kMaxHeights> slots_{};
};

}  // namespace plumb
