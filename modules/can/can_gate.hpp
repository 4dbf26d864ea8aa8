/// Decides what may be sent now: fixed cycles, every camera frame at least once, and "not
/// available" as soon as values are too old or not valid. Pure: time is passed in.
///
/// Age:
///   It is counted from the capture of the image, at every tick. Where that time is not known, or
///   lies ahead, nothing of the frame is sent. Of frames that wait, those that have become too old
///   are passed over.
/// Pairing:
///   The ground plane and the ego motion of one `seq` become one entry of a queue. Each tick takes
///   at most one entry, whose messages leave in one burst, and repeats the messages that are due.
/// Mount:
///   It belongs to no frame. Each one is sent once, at the next tick, and repeated by its cycle.
///   Its age is counted from its receipt: it tells of minutes.
/// Time:
///   [us] of one steady clock of the caller's choice, which is that of capture_mono_us; in a replay
///   the log's own clock.
/// Memory:
///   kMaxPending entries in place. When the queue is full, the oldest is dropped and counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/can_frame.hpp"
#include "core/counters.hpp"
#include "core/fixed_queue.hpp"
#include "modules/can/can_config.hpp"
#include "modules/can/can_sample.hpp"
#include "modules/can/can_signal.hpp"

namespace plumb {

struct CanCounters {
  std::int64_t num_frames = 0;      ///< entries whose burst was sent
  std::int64_t num_missed = 0;      ///< camera frames missing by seq
  std::int64_t num_unpaired = 0;    ///< frames whose second half did not come in time
  std::int64_t num_repeated = 0;    ///< halves that had been taken already: ignored
  std::int64_t num_overflowed = 0;  ///< entries dropped because the queue was full
  std::int64_t num_passed = 0;      ///< entries passed over because they had become too old
  std::int64_t num_late = 0;        ///< halves that were too old on receipt
  std::int64_t num_rejected = 0;    ///< told by the caller: messages that broke their contract
  std::int64_t num_unsent = 0;      ///< told by the caller: frames that the bus did not take
};

class CanGate {
 public:
  static constexpr int kTickMs = CanConfig::kTickMs;
  static constexpr std::int64_t kTickUs = 1'000 * kTickMs;
  static constexpr std::size_t kMaxPending = 32;  ///< sent in 0.32 s
  /// When full the oldest is dropped: the newest replaces it anyway.
  static constexpr std::size_t kMaxPendingMounts = 4;

  /// @pre `messages` are those of this `config`
  CanGate(const CanConfig& config, const Messages& messages);

  void on_ground_plane(const CanSample& plane, std::int64_t now_us);
  void on_ego_motion(const CanSample& ego, std::int64_t now_us);
  void on_mount(const CanSample& mount, std::int64_t now_us);

  /// Sends what is due. Call it every kTickUs; it does not make up for missed calls.
  void tick(std::int64_t now_us, CanSink& sink);

  /// What tells this run from others in Frame_StartCtr.
  void set_start(std::uint32_t start) { start_ = start; }
  /// Sets the counts that only the caller knows.
  void report(std::int64_t num_rejected, std::int64_t num_unsent);

  [[nodiscard]] const CanCounters& counters() const { return counters_; }
  /// Returns whether nothing waits to be sent.
  [[nodiscard]] bool idle() const {
    return pending_.empty() && !is_open_ && !is_changed_ && pending_mounts_.empty();
  }

 private:
  struct Entry {
    std::int64_t seq = 0;
    std::int64_t session = 0;
    std::int64_t received_us = 0;
    bool has_plane = false;
    bool has_ego = false;
    CanSample plane;
    CanSample ego;
  };

  struct MountEntry {
    std::int64_t received_us = 0;
    CanSample mount;
  };

  /// What can be sent now. A null pointer: not received, too old, or of unknown age.
  struct Available {
    const CanSample* ego = nullptr;
    const CanSample* plane = nullptr;
    const CanSample* mount = nullptr;
    CanState state;
  };

  Entry* take(const CanSample& half, std::int64_t now_us);
  Entry* entry_of(const CanSample& half, std::int64_t now_us);
  Entry* newest_closed(const CanSample& half);
  void settle(const Entry& entry);
  void close();
  bool next(std::int64_t now_us);
  bool next_mount();
  [[nodiscard]] bool is_fresh(const CanSample& half, std::int64_t now_us) const;
  [[nodiscard]] bool has_fresh_half(const Entry& entry, std::int64_t now_us) const;
  [[nodiscard]] CanMode mode_without_values(std::int64_t now_us) const;
  [[nodiscard]] CanState state(const CanSample* ego, const CanSample* plane,
                               std::int64_t now_us) const;
  [[nodiscard]] Available available(std::int64_t now_us) const;
  [[nodiscard]] static MessageValues compose(const Message& message, const Available& now);

  Messages messages_;
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
  std::int64_t session_ = 0;  ///< of the newest frame
  std::int64_t start_us_ = 0;
  bool is_started_ = false;
  std::uint32_t start_ = 0;
  std::array<int, kNumMessages> ms_since_sent_{};
  std::array<std::uint8_t, kNumMessages> alive_{};
  CanCounters counters_;
};

}  // namespace plumb
