/// Physical values <-> CAN frames. The messages are tables (can_messages.cpp); the DBC says the
/// same.
///
/// Units   SI, signs per ISO 8855 (x forward, y left, z up), stated per signal in
///         config/plumbline.dbc.
/// Raw     unsigned; physical = raw * factor + offset. A signal with `has_sna` keeps all ones for
///         "not available" (NaN here) and saturates at all ones - 1 and at 0: a value never wraps.
/// Memory  values in, frame out; nothing is kept.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/can_frame.hpp"

namespace plumb {

inline constexpr double kNotAvailable = std::numeric_limits<double>::quiet_NaN();

/// What all messages say together, in physical units. NaN: not available.
struct CanValues {
  double frame_counter = 0.0;  ///< seq modulo 256 of the camera frame; always a number

  double ego_validity = kNotAvailable;  ///< CanValidity
  double standstill = kNotAvailable;    ///< 0 moving, 1 standstill
  double speed_m_s = kNotAvailable;     ///< forward, of the camera
  double yaw_rate_rad_s = kNotAvailable;
  double speed_std_m_s = kNotAvailable;
  double lateral_speed_m_s = kNotAvailable;
  double accel_m_s2 = kNotAvailable;
  double accel_std_m_s2 = kNotAvailable;
  double yaw_rate_std_rad_s = kNotAvailable;

  double plane_validity = kNotAvailable;  ///< CanValidity
  double pitch_rad = kNotAvailable;       ///< nose down positive
  double roll_rad = kNotAvailable;        ///< right side down positive
  double height_m = kNotAvailable;
  double pitch_std_rad = kNotAvailable;
  double roll_std_rad = kNotAvailable;
  double height_std_m = kNotAvailable;
  double cues_used = kNotAvailable;  ///< 1 dense + 2 points + 4 objects

  double x_m = kNotAvailable;
  double y_m = kNotAvailable;
  double z_m = kNotAvailable;
  double heading_rad = kNotAvailable;
  double distance_m = kNotAvailable;
  double reset_counter = kNotAvailable;  ///< modulo 255
  double scale_std_ratio = kNotAvailable;

  double mode = kNotAvailable;  ///< CanMode
  double ego_status = kNotAvailable;
  double ego_reason = kNotAvailable;
  double plane_status = kNotAvailable;
  double plane_reason = kNotAvailable;
  double num_missed = kNotAvailable;
  double num_overflowed = kNotAvailable;
  double num_rejected = kNotAvailable;
  double num_unsent = kNotAvailable;

  double database_version = kNotAvailable;
  double version_major = kNotAvailable;
  double version_minor = kNotAvailable;
  double version_patch = kNotAvailable;
  double uptime_s = kNotAvailable;

  double mount_status = kNotAvailable;  ///< CanMountStatus
  double mount_reason = kNotAvailable;
  double mount_progress = kNotAvailable;   ///< [0, 1] of the way to a reference
  double mount_pitch_rad = kNotAvailable;  ///< off the reference; signs as pitch_rad, roll_rad
  double mount_roll_rad = kNotAvailable;
  double mount_yaw_rad = kNotAvailable;  ///< left positive

  // Of the list of objects, and of one object in it.
  double object_frame_counter = 0.0;  ///< seq modulo 256 of the image searched; always a number
  double num_objects = kNotAvailable;
  double num_objects_left_out = kNotAvailable;
  double object_index = 0.0;  ///< in the list; always a number
  double object_x_m = kNotAvailable;
  double object_y_m = kNotAvailable;
  double object_x_std_m = kNotAvailable;
  double object_y_std_m = kNotAvailable;
  double object_vx_m_s = kNotAvailable;  ///< over ground
  double object_vy_m_s = kNotAvailable;
  double object_vx_std_m_s = kNotAvailable;
  double object_vy_std_m_s = kNotAvailable;
  double object_id = kNotAvailable;  ///< modulo 255
  double object_class = kNotAvailable;
  double object_status = kNotAvailable;
  double object_age_s = kNotAvailable;
  double object_ttc_s = kNotAvailable;
  double object_width_m = kNotAvailable;
};

enum class ByteOrder : std::uint8_t { kIntel, kMotorola };

/// One row of a message's table; `value` is null for the E2E fields, which e2e_protect() fills.
struct Signal {
  const char* name = "";
  int start_bit =
      0;           ///< as in a DBC: least significant bit (Intel), most significant bit (Motorola)
  int length = 0;  ///< bits, at most 32
  double factor = 1.0;
  double offset = 0.0;
  double CanValues::*value = nullptr;
  bool has_sna = true;
  ByteOrder order = ByteOrder::kIntel;
};

/// Largest raw value that stands for a physical one.
[[nodiscard]] constexpr std::uint64_t max_raw(const Signal& signal) {
  return (std::uint64_t{1} << static_cast<unsigned>(signal.length)) - (signal.has_sna ? 2U : 1U);
}
[[nodiscard]] constexpr double min_physical(const Signal& signal) { return signal.offset; }
[[nodiscard]] constexpr double max_physical(const Signal& signal) {
  return static_cast<double>(max_raw(signal)) * signal.factor + signal.offset;
}

/// What makes a message leave between its cycles.
enum class CanTrigger : std::uint8_t { kNone, kCameraFrame, kMountMessage };

/// One row of the send table.
struct Message {
  const char* name = "";
  std::uint32_t id = 0;
  std::uint16_t data_id = 0;  ///< AUTOSAR E2E
  int cycle_ms = 0;           ///< 0: sent only with what it belongs to
  CanTrigger trigger = CanTrigger::kNone;
  std::span<const Signal> signals;
};

inline constexpr std::size_t kMessageBytes = 8;
inline constexpr std::size_t kNumMessages = 10;
inline constexpr std::size_t kNumObjectMessages = 4;
inline constexpr int kDatabaseVersion = 3;  ///< +1 with every change of the DBC's layout

/// Every message of ego motion, ground plane and mount, in the order in which a burst sends them.
[[nodiscard]] const std::array<Message, kNumMessages>& messages();
/// The list of objects, then what is sent for each object: position, motion, state.
[[nodiscard]] const std::array<Message, kNumObjectMessages>& object_messages();

/// Nearest raw value; saturates, and NaN becomes "not available" (0 where the signal has none).
[[nodiscard]] std::uint64_t to_raw(const Signal& signal, double physical);
/// NaN for "not available".
[[nodiscard]] double to_physical(const Signal& signal, std::uint64_t raw);

/// @pre the signal lies inside `data`, raw < 2^length
void insert_raw(const Signal& signal, std::uint64_t raw, std::span<std::uint8_t> data);
[[nodiscard]] std::uint64_t extract_raw(const Signal& signal, std::span<const std::uint8_t> data);

/// The message's frame with these values, alive counter and CRC. @pre alive < kE2eCounterModulo
[[nodiscard]] CanFrame encode(const Message& message, const CanValues& values, std::uint8_t alive);

/// Overwrites the values the frame carries. False, leaving them alone, when identifier, size, CRC
/// or counter are not this message's.
[[nodiscard]] bool decode(const Message& message, const CanFrame& frame, CanValues* values);

}  // namespace plumb
