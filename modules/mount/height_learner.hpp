/// Learns the height of the camera over its road from the speed of the vehicle.
///
/// VO and the ground plane tell how many camera heights the camera has moved, whatever the height
/// is. The vehicle's own speed tells how many metres. Over a stretch of straight, steady driving
/// the quotient is the height in metres. Stretches agree up to noise; what all of them share, such
/// as the tyres' circumference, does not average out and stays in the standard deviation.
///
/// Order:
///   A step waits until the speeds reach its end, and is left out when they do not within
///   kMostSteps images. A stretch takes effect kDelay_us of image time after its end. Results
///   depend on the messages of either kind, and not on the order in which the two kinds arrive.
/// Units:
///   Metres, microseconds; variances are those of ln height.
/// Memory:
///   Rings in place; nothing grows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/fixed_queue.hpp"
#include "core/numbers.hpp"
#include "modules/ground/types/camera_height.hpp"
#include "modules/ground/types/ground_types.hpp"
#include "modules/mount/mount_config.hpp"
#include "modules/mount/speed_track.hpp"

namespace plumb {

/// The numbers are those of mount_t.HEIGHT_*.
enum class HeightStatus : std::int8_t {
  kStated = 0,
  kLearning = 1,
  kLearned = 2,
  kContradicted = 3
};

struct HeightReport {
  HeightStatus status = HeightStatus::kStated;
  int num_stretches = 0;
  CameraHeight by_vehicle{kNan, kNan};  ///< NaN before kLeastStretches
  CameraHeight used{kNan, kNan};        ///< NaN before a height is stated
};

class HeightLearner {
 public:
  static constexpr std::size_t kMostStretches = 64;
  static constexpr int kLeastStretches = 4;
  static constexpr std::size_t kMostSteps = 16;
  static constexpr std::int64_t kDelay_us = 500'000;

  explicit HeightLearner(const MountConfig& config) : config_(config) {}

  /// Returns null, or why the speed is refused.
  [[nodiscard]] const char* take_speed(const VehicleSpeed& speed);
  /// Takes a ground result and the height that the calibration or the configuration states. The
  /// report is valid until the next call.
  const HeightReport& update(const GroundOutput& ground, const CameraHeight& stated);
  /// Another camera: what was learned of the last one is void. The vehicle's speeds stay.
  void forget();
  [[nodiscard]] const HeightReport& report() const { return report_; }

 private:
  struct Step {
    std::int64_t begin_us = 0;
    std::int64_t end_us = 0;
    double heights = 0.0;
    double ln_var = 0.0;
  };
  struct Stretch {
    double ln_height = 0.0;
    double var = 0.0;
    std::int64_t end_us = 0;
  };

  void use_steps();
  void add(const Step& step, double way_m);
  void take_effect(std::int64_t now_us);
  void estimate();
  void combine(const CameraHeight& stated, double dt_s);

  MountConfig config_;
  SpeedTrack track_;
  std::int64_t last_us_ = 0;
  FixedQueue<Step, kMostSteps> steps_;
  // The stretch that is being driven.
  double heights_ = 0.0;
  double way_m_ = 0.0;
  double var_sum_ = 0.0;  ///< of the steps' ln_var, each times its way
  FixedQueue<Stretch, 4> ended_;
  std::array<Stretch, kMostStretches> stretches_{};
  std::size_t num_stretches_ = 0;  ///< since construction or forget()
  double ln_height_ = kNan;        ///< by the vehicle's speed
  double var_ = kNan;
  HeightReport report_;
};

}  // namespace plumb
