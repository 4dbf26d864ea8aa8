/// Decides when lists of objects go onto the bus: each once, as one burst, and "not available" when
/// they stop coming.
///
/// Burst:
///   The list's message, then position, motion and state of each object leave in one tick. All
///   carry the frame counter. Between bursts the list's message repeats by its own cycle.
/// Silence:
///   Nothing is sent before the first list: a system without plumb-objects has no object messages
///   on its bus.
/// Age:
///   As CanGate: from the capture of the image that was searched. Of a list that is too old only
///   its own message is sent, as "not available"; lists that wait are then passed over.
/// Time:
///   As CanGate, whose ticks these are.
/// Memory:
///   kMaxPending lists in place. When the queue is full, the oldest is dropped and counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/can_frame.hpp"
#include "core/fixed_queue.hpp"
#include "modules/can/can_config.hpp"
#include "modules/can/can_signal.hpp"

namespace plumb {

/// What one OBJECTS gives to the bus, the nearest object first.
struct CanObjects {
  std::int64_t seq = 0;
  std::int64_t capture_mono_us = 0;  ///< on the gates' clock; 0: not known
  CanObjectCounts counts;
  std::array<SourceValues, kMaxCanObjects> objects;
};

class CanObjectGate {
 public:
  static constexpr std::size_t kMaxPending = 16;

  /// @pre `messages` are those of this `config`
  CanObjectGate(const CanConfig& config, const Messages& messages);

  void on_objects(const CanObjects& objects, std::int64_t now_us);
  /// Sends what is due. Call it with every tick of CanGate.
  void tick(std::int64_t now_us, CanSink& sink);

  [[nodiscard]] bool idle() const { return pending_.empty(); }
  /// Lists dropped because the queue was full, or passed over because they had become too old.
  [[nodiscard]] std::int64_t num_overflowed() const { return num_overflowed_; }
  /// Lists that were too old on receipt.
  [[nodiscard]] std::int64_t num_late() const { return num_late_; }

 private:
  [[nodiscard]] bool is_fresh(const CanObjects& list, std::int64_t now_us) const;
  void send_list(std::int64_t now_us, CanSink& sink);
  void send_object(std::size_t index, std::int64_t now_us, CanSink& sink);
  void send(std::size_t message, const MessageValues& values, std::size_t index,
            std::int64_t now_us, CanSink& sink);

  Messages messages_;
  std::int64_t stale_us_;
  FixedQueue<CanObjects, kMaxPending> pending_;
  CanObjects current_;
  bool has_current_ = false;
  int ms_since_list_ = 0;
  std::int64_t num_overflowed_ = 0;
  std::int64_t num_late_ = 0;
  std::array<std::uint8_t, kNumMessages> alive_{};
};

}  // namespace plumb
