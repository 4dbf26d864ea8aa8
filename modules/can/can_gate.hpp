/// Decides what may be sent now: fixed cycles, every camera frame at least once, and "not
/// available" as soon as values are too old or do not hold. Pure: time is passed in.
///
/// Pairing  the ground plane and the ego motion of one `seq` become one entry of a queue; each tick
///          takes at most one entry, whose messages leave in one burst, and repeats what is cyclic.
/// Mount    belongs to no frame: each is sent once, at the next tick, and repeated by its cycle.
/// Time     [us] of one steady clock of the caller's choice; the log's own clock in a replay.
/// Units    SI, signs per ISO 8855.
/// Memory   kMaxPending entries in place; when full the oldest is dropped and counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/can_frame.hpp"
#include "core/counters.hpp"
#include "core/fixed_queue.hpp"
#include "modules/can/can_codec.hpp"
#include "modules/can/can_config.hpp"

namespace plumb {

/// Same numbers as ego_motion_t.STATUS_* (asserted in can_wire.cpp).
enum class CanEgoStatus : std::int8_t {
  kOk = 0,
  kInitializing = 1,
  kScaleHeld = 2,
  kStandstill = 3,
  kCoasting = 4,
  kLost = 5,
};

/// Same numbers as ground_plane_t.STATUS_* (asserted in can_wire.cpp).
enum class CanPlaneStatus : std::int8_t { kOk = 0, kInitializing = 1, kHeld = 2, kInvalid = 3 };

/// What a receiver may do with the values beside it. All ones, not available: nothing was received,
/// or it is too old.
enum class CanValidity : std::int8_t {
  kInvalid = 0,  ///< the source answers, but its values do not hold: they are sent as not available
  kDegraded = 1,  ///< predicted; the deviation says how far to trust it
  kValid = 2,
};

enum class CanMode : std::int8_t {
  kNoInput = 0,
  kInitializing = 1,
  kNormal = 2,
  kDegraded = 3,
  kFailed = 4,
};

/// One ego motion. Motion and pose hold unless kInitializing or kLost; NaN marks a single value
/// that is not known.
struct CanEgo {
  std::int64_t seq = 0;
  CanEgoStatus status = CanEgoStatus::kLost;
  int reason = 0;                  ///< vo_motion_t.REASON_*
  std::int32_t reset_counter = 0;  ///< always holds
  double speed_m_s = kNotAvailable;
  double speed_std_m_s = kNotAvailable;
  double lateral_speed_m_s = kNotAvailable;
  double yaw_rate_rad_s = kNotAvailable;
  double yaw_rate_std_rad_s = kNotAvailable;
  double accel_m_s2 = kNotAvailable;
  double accel_std_m_s2 = kNotAvailable;
  double x_m = kNotAvailable;  ///< axes of the first image: x forward, y left, z up
  double y_m = kNotAvailable;
  double z_m = kNotAvailable;
  double heading_rad = kNotAvailable;
  double distance_m = kNotAvailable;
  double scale_std_ratio = kNotAvailable;
};

/// One ground plane; holds in kOk and kHeld.
struct CanPlane {
  std::int64_t seq = 0;
  CanPlaneStatus status = CanPlaneStatus::kInvalid;
  int reason = 0;  ///< ground_plane_t.REASON_*
  double pitch_rad = kNotAvailable;
  double roll_rad = kNotAvailable;
  double height_m = kNotAvailable;
  double pitch_std_rad = kNotAvailable;
  double roll_std_rad = kNotAvailable;
  double height_std_m = kNotAvailable;
  int cues_used = 0;  ///< 1 dense + 2 points + 4 objects
};

/// Same numbers as mount_t.STATUS_* (asserted in can_wire.cpp).
enum class CanMountStatus : std::int8_t {
  kCollecting = 0,
  kUnsteady = 1,
  kSteady = 2,
  kMoved = 3,
};

/// How the camera sits on its vehicle. The angles are off the reference, in kSteady and kMoved.
struct CanMount {
  CanMountStatus status = CanMountStatus::kCollecting;
  int reason = 0;  ///< mount_t.REASON_*
  double progress = kNotAvailable;
  double pitch_rad = kNotAvailable;
  double roll_rad = kNotAvailable;
  double yaw_rad = kNotAvailable;
};

struct CanCounters {
  std::int64_t num_frames = 0;      ///< entries whose burst was sent
  std::int64_t num_missed = 0;      ///< camera frames missing by seq
  std::int64_t num_unpaired = 0;    ///< frames whose second half did not come in time
  std::int64_t num_repeated = 0;    ///< halves that had been taken already: ignored
  std::int64_t num_overflowed = 0;  ///< entries dropped because the queue was full
  std::int64_t num_rejected = 0;    ///< told by the caller: messages that broke their contract
  std::int64_t num_unsent = 0;      ///< told by the caller: frames that the bus did not take
};

class CanGate {
 public:
  static constexpr std::int64_t kTickUs = 10'000;
  static constexpr int kTickMs = static_cast<int>(kTickUs / 1'000);
  static constexpr std::size_t kMaxPending = 32;  ///< sent in 0.32 s
  /// When full the oldest goes: the newest says it all.
  static constexpr std::size_t kMaxPendingMounts = 4;

  explicit CanGate(const CanConfig& config);

  void on_ground_plane(const CanPlane& plane, std::int64_t now_us);
  void on_ego_motion(const CanEgo& ego, std::int64_t now_us);
  void on_mount(const CanMount& mount, std::int64_t now_us);

  /// Sends what is due. Call every kTickUs; a late call is not made up for.
  void tick(std::int64_t now_us, CanSink& sink);

  /// What only the caller can count.
  void report(std::int64_t num_rejected, std::int64_t num_unsent);

  [[nodiscard]] const CanCounters& counters() const { return counters_; }
  /// Nothing waits to be sent.
  [[nodiscard]] bool idle() const {
    return pending_.empty() && !is_open_ && !is_changed_ && pending_mounts_.empty();
  }

 private:
  struct Entry {
    std::int64_t seq = 0;
    std::int64_t received_us = 0;
    bool has_plane = false;
    bool has_ego = false;
    CanPlane plane;
    CanEgo ego;
  };

  struct MountEntry {
    std::int64_t received_us = 0;
    CanMount mount;
  };

  Entry* entry_of(std::int64_t seq, std::int64_t now_us);
  Entry* newest_closed(std::int64_t seq);
  void settle(const Entry& entry);
  void close();
  bool next(std::int64_t now_us);
  bool next_mount();
  [[nodiscard]] CanValues compose(std::int64_t now_us) const;

  std::int64_t stale_us_;
  std::int64_t pair_wait_us_;
  FixedQueue<Entry, kMaxPending> pending_;
  Entry open_;  ///< the frame whose second half is awaited
  bool is_open_ = false;
  Entry current_;  ///< what is repeated
  bool has_current_ = false;
  bool is_changed_ = false;  ///< a late half joined `current_`
  FixedQueue<MountEntry, kMaxPendingMounts> pending_mounts_;
  MountEntry mount_;  ///< what is repeated
  bool has_mount_ = false;
  LossCounter order_;
  std::int64_t start_us_ = 0;
  bool is_started_ = false;
  std::array<int, kNumMessages> ms_since_sent_{};
  std::array<std::uint8_t, kNumMessages> alive_{};
  CanCounters counters_;
};

}  // namespace plumb
