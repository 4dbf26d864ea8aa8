/// Decides when lists of objects go onto the bus: each once, as one burst, and "not available" when they stop coming.
///
/// Burst   PLB_ObjectList, then position, motion and state of each object, in one tick; all carry the frame counter and
///         none of another frame comes between. Between bursts PLB_ObjectList repeats by its own cycle.
/// Silence until a first list came: a system without plumb-objects has no object messages on its bus.
/// Time    as CanGate, whose ticks these are.
/// Memory  kMaxPending lists in place; when full the oldest is dropped and counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/can_frame.hpp"
#include "core/fixed_queue.hpp"
#include "modules/can/can_codec.hpp"
#include "modules/can/can_config.hpp"

namespace plumb {

/// Same numbers as object_t.STATUS_* (asserted in can_wire.cpp).
enum class CanObjectStatus : std::int8_t { kMeasured = 0, kPredicted = 1, kNotLocalised = 2 };

/// One object with a place on the road. NaN marks a value that is not known.
struct CanObject {
  std::int32_t id = 0;
  int object_class = 0;  ///< detection_t.CLASS_*
  CanObjectStatus status = CanObjectStatus::kMeasured;
  double x_m = kNotAvailable;  ///< ground: x forward, y left, from the road under the camera
  double y_m = kNotAvailable;
  double x_std_m = kNotAvailable;
  double y_std_m = kNotAvailable;
  double vx_m_s = kNotAvailable;  ///< over ground
  double vy_m_s = kNotAvailable;
  double vx_std_m_s = kNotAvailable;
  double vy_std_m_s = kNotAvailable;
  double width_m = kNotAvailable;
  double time_to_collision_s = kNotAvailable;
  double age_s = kNotAvailable;
};

inline constexpr std::size_t kMaxCanObjects = 8;

struct CanObjects {
  std::int64_t seq = 0;
  std::size_t num_objects = 0;    ///< nearest first
  std::int64_t num_left_out = 0;  ///< not sent: further away, or without a place
  std::array<CanObject, kMaxCanObjects> objects;
};

class CanObjectGate {
 public:
  static constexpr std::size_t kMaxPending = 16;

  explicit CanObjectGate(const CanConfig& config);

  void on_objects(const CanObjects& objects, std::int64_t now_us);
  /// Sends what is due; call with every tick of CanGate.
  void tick(std::int64_t now_us, CanSink& sink);

  [[nodiscard]] bool idle() const { return pending_.empty(); }
  [[nodiscard]] std::int64_t num_overflowed() const { return num_overflowed_; }

 private:
  struct Entry {
    std::int64_t received_us = 0;
    CanObjects list;
  };
  void send(std::size_t message, const CanValues& values, std::int64_t now_us, CanSink& sink);

  std::int64_t stale_us_;
  FixedQueue<Entry, kMaxPending> pending_;
  Entry current_;
  bool has_current_ = false;
  int ms_since_list_ = 0;
  std::int64_t num_overflowed_ = 0;
  std::array<std::uint8_t, kNumObjectMessages> alive_{};
};

}  // namespace plumb
