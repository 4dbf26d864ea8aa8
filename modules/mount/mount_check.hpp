/// Watches how the camera sits on its vehicle: a reference out of the first straight stretches, then
/// an alarm when the camera no longer sits like that. Height is not watched: it is what the scale
/// is made of.
///
/// Angles  (pitch, roll, yaw) [rad]: pitch and roll of the camera against the road, nose and right
///         side down positive; yaw positive when it looks left of the direction of travel.
/// Memory  a ring of stretches in place; nothing grows.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "modules/ground/types/ground_types.hpp"
#include "modules/mount/mount_config.hpp"

namespace plumb {

/// Same numbers as mount_t.STATUS_*.
enum class MountStatus : std::int8_t { kCollecting = 0, kUnsteady = 1, kSteady = 2, kMoved = 3 };

/// Same numbers as mount_t.REASON_*.
enum class MountReason : std::int8_t {
  kNone = 0,
  kNoMotion = 1,
  kNoPlane = 2,
  kSlow = 3,
  kTurning = 4,
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
  Eigen::Vector3d recent_rad;  ///< NaN before the first stretch
  Eigen::Vector3d spread_rad;  ///< NaN before the second
};

/// One `update` per ground result, in order. Deterministic.
class MountCheck {
 public:
  static constexpr std::size_t kMaxStretches = 64;
  static constexpr std::size_t kNumRecent = 4;

  /// @pre config inside the ranges of its visit()
  explicit MountCheck(const MountConfig& config);

  /// Goes on from a reference that an earlier run made.
  void restore(const MountReference& reference);
  /// The report stays valid until the next call.
  const MountReport& update(const GroundOutput& ground);
  [[nodiscard]] const MountReport& report() const { return report_; }

 private:
  void end_stretch();
  void make_reference();
  void judge();
  /// Of the newest `count` stretches.
  [[nodiscard]] Eigen::Vector3d mean(std::size_t count) const;
  [[nodiscard]] Eigen::Vector3d spread(std::size_t count) const;
  [[nodiscard]] const Eigen::Vector3d& newest(std::size_t back) const;

  MountConfig config_;
  std::array<Eigen::Vector3d, kMaxStretches> stretches_;
  std::size_t num_stretches_ = 0;  ///< ever
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  double way_m_ = 0.0;
  MountReport report_;
};

}  // namespace plumb
