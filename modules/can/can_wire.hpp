/// GROUND_PLANE, EGO_MOTION, MOUNT and OBJECTS -> CAN frames: what plumb-can runs live and
/// plumb-replay runs on a log.
///
/// The input is the LCM message, also in a replay: quaternions and matrices round differently, and
/// "live equals replay" is judged bit for bit.
///
/// Way of a message:
///   Its contract (fault_of), its sender (CanSourceGuard), the vehicle's limits (MotionJudge and
///   PlaneJudge), the ranges of the signals (settle_values), its age (CanGate, at every tick).
/// Live:
///   Call on_*(message, monotonic_us()) as messages arrive, and tick(monotonic_us(), sink) from a
///   timer of CanGate::kTickUs. The clock is that of capture_mono_us.
/// Replay:
///   For each message call advance(message.utime, sink), then on_*(message, message.utime); at the
///   end finish(sink).
#pragma once

#include <cstdint>

#include "modules/can/can_gate.hpp"
#include "modules/can/can_object_gate.hpp"
#include "modules/can/can_source.hpp"
#include "modules/can/judge_wire.hpp"
#include "modules/can/sample_wire.hpp"
#include "modules/can/signals/signal_tables.hpp"
#include "modules/integrity/plausibility_config.hpp"

namespace plumb {

class CanOutput {
 public:
  /// Throws InputError for identifiers and cycles that do not fit together, see can_addresses().
  explicit CanOutput(const CanConfig& config, const PlausibilityConfig& vehicle = {});

  /// The start of this run [us]: receivers shall see that a counter began anew. Before the first
  /// message; a replay leaves it alone.
  void set_session(std::int64_t session_us);

  /// They return null, or why the message was rejected and counted.
  const char* on_ground_plane(const ground_plane_t& message, std::int64_t now_us);
  const char* on_ego_motion(const ego_motion_t& message, std::int64_t now_us);
  const char* on_mount(const mount_t& message, std::int64_t now_us);
  const char* on_objects(const objects_t& message, std::int64_t now_us);

  /// Sends what is due at one tick of the caller's timer.
  void tick(std::int64_t now_us, CanSink& sink);

  /// Virtual clock: runs every tick up to and including `now_us`. After a step back, or one of more
  /// than kMaxStepUs forward, it sends what waits and starts a new grid of ticks at `now_us`.
  void advance(std::int64_t now_us, CanSink& sink);
  /// Runs ticks until no frame waits.
  void finish(CanSink& sink);

  /// What only the caller can count, for PLB_Status: messages that did not decode, and frames that
  /// the bus did not take.
  void report(std::int64_t num_undecoded, std::int64_t num_unsent) {
    num_undecoded_ = num_undecoded;
    num_unsent_ = num_unsent;
  }
  [[nodiscard]] std::int64_t num_rejected() const { return num_rejected_; }
  [[nodiscard]] const CanCounters& counters() const { return gate_.counters(); }
  /// Lists of objects that came faster than they could be sent, or became too old before.
  [[nodiscard]] std::int64_t num_objects_overflowed() const {
    return object_gate_.num_overflowed();
  }
  /// Messages whose image was too old on receipt.
  [[nodiscard]] std::int64_t num_late() const {
    return gate_.counters().num_late + object_gate_.num_late();
  }
  /// Messages of which a value was refused because no road vehicle can have it.
  [[nodiscard]] std::int64_t num_implausible() const {
    return motion_judge_.num_refused() + plane_judge_.num_refused();
  }
  /// Why the newest of these was refused.
  [[nodiscard]] PlausibilityReason motion_refusal() const { return motion_judge_.last_reason(); }
  [[nodiscard]] PlausibilityReason plane_refusal() const { return plane_judge_.last_reason(); }

 private:
  static constexpr std::int64_t kMaxStepUs = 10'000'000;

  const char* counted(const char* fault);

  Messages messages_;
  CanSourceGuard source_;
  MotionJudge motion_judge_;
  PlaneJudge plane_judge_;
  CanGate gate_;
  CanObjectGate object_gate_;
  CanSample sample_;
  CanObjects objects_;
  std::int64_t num_rejected_ = 0;
  std::int64_t num_undecoded_ = 0;
  std::int64_t num_unsent_ = 0;
  std::int64_t next_tick_us_ = 0;
  bool is_started_ = false;
};

}  // namespace plumb
