/// Monitors the orientation of the camera on its vehicle. The first straight stretches of road give
/// a reference; an alarm is raised when the orientation later differs from it, and another one when
/// the direction of travel is far off the optical axis. The height is not monitored, because the
/// metric scale is derived from it.
///
/// Angles:
///   (pitch, roll, yaw) [rad]: pitch and roll of the camera against the road, nose and right side
///   down positive; yaw positive when the camera looks left of the direction of motion.
/// Memory:
///   A ring buffer of stretches in place. Nothing is allocated.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "modules/ground/types/ground_types.hpp"
#include "modules/mount/mount_config.hpp"

namespace plumb {

/// The numbers are those of mount_t.STATUS_*.
enum class MountStatus : std::int8_t {
  kCollecting = 0,
  kUnsteady = 1,
  kSteady = 2,
  kMoved = 3,
  kMisaligned = 4,
};

/// The numbers are those of mount_t.REASON_*.
enum class MountReason : std::int8_t {
  kNone = 0,
  kNoMotion = 1,
  kNoPlane = 2,
  kSlow = 3,
  kTurning = 4,
  kUpsideDown = 5,
};

struct MountReference {
  Eigen::Vector3d mean_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d std_rad = Eigen::Vector3d::Zero();
  int num_stretches = 0;
};

struct MountReport {
  MountStatus status = MountStatus::kCollecting;
  MountReason reason = MountReason::kNoMotion;
  double progress = 0.0;
  int num_stretches = 0;
  std::optional<MountReference> reference;
  Eigen::Vector3d recent_rad;  ///< mean of the newest stretches; NaN before the first
  Eigen::Vector3d spread_rad;  ///< standard deviation of stretches; NaN before the second
};

/// Takes one update() per ground result, in order. Deterministic.
class MountCheck {
 public:
  static constexpr std::size_t kMaxStretches = 64;
  static constexpr std::size_t kNumRecent = 4;

  /// @pre the settings are inside the ranges of visit()
  explicit MountCheck(const MountConfig& config);

  /// Continues with a reference that an earlier run made.
  void restore(const MountReference& reference);
  /// Adds a ground result. The report is valid until the next call.
  const MountReport& update(const GroundOutput& ground);
  [[nodiscard]] const MountReport& report() const { return report_; }

 private:
  void end_stretch();
  void make_reference();
  void judge();
  [[nodiscard]] bool is_misaligned() const;
  /// Mean of the newest `count` stretches.
  [[nodiscard]] Eigen::Vector3d mean(std::size_t count) const;
  /// Standard deviation of the newest `count` stretches.
  [[nodiscard]] Eigen::Vector3d spread(std::size_t count) const;
  [[nodiscard]] const Eigen::Vector3d& newest(std::size_t back) const;

  MountConfig config_;
  std::array<Eigen::Vector3d, kMaxStretches> stretches_;
  std::size_t num_stretches_ = 0;  ///< since construction
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  double distance_m_ = 0.0;
  MountStatus status_ = MountStatus::kCollecting;  ///< as the reference alone tells it
  MountReport report_;
};

}  // namespace plumb
