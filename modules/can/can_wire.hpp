/// GROUND_PLANE, EGO_MOTION, MOUNT and OBJECTS -> CAN frames: what plumb-can runs live and
/// plumb-replay runs on a log.
///
/// The input is the LCM message, also in a replay: quaternions and matrices round differently, and
/// "live equals replay" is judged bit for bit.
///
/// Live:
///   Call on_*(message, monotonic_us()) as messages arrive, and tick(monotonic_us(), sink) from a
///   timer of CanGate::kTickUs.
/// Replay:
///   For each message call advance(message.utime, sink), then on_*(message, message.utime); at the
///   end finish(sink).
#pragma once

#include <cstdint>

#include "modules/can/can_gate.hpp"
#include "modules/can/can_object_gate.hpp"
#include "modules/can/signals/signal_tables.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/objects_t.hpp"

namespace plumb {

/// Fills the output with the values of all signals that come from the message, and returns null.
/// Returns what is wrong when the message breaks its contract: an unknown status, a negative seq,
/// or a value that is not a number, or has a negative variance, although the status says it is
/// valid. @pre `messages` come from can_messages()
[[nodiscard]] const char* from_wire(const ego_motion_t& message, const Messages& messages,
                                    CanSample* ego);
[[nodiscard]] const char* from_wire(const ground_plane_t& message, const Messages& messages,
                                    CanSample* plane);
[[nodiscard]] const char* from_wire(const mount_t& message, const Messages& messages,
                                    CanSample* mount);
/// Takes the nearest kMaxCanObjects that have a place on the road, the nearest first. One broken
/// object breaks the message.
[[nodiscard]] const char* from_wire(const objects_t& message, const Messages& messages,
                                    CanObjects* objects);

class CanOutput {
 public:
  /// Throws InputError for identifiers and cycles that do not fit together, see can_addresses().
  explicit CanOutput(const CanConfig& config);

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
  /// Lists of objects that came faster than they could be sent.
  [[nodiscard]] std::int64_t num_objects_overflowed() const {
    return object_gate_.num_overflowed();
  }

 private:
  static constexpr std::int64_t kMaxStepUs = 10'000'000;

  const char* counted(const char* fault);

  Messages messages_;
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
