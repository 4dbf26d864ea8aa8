/// A signal and a message as tables: what the codec, the gates and the DBC are made from.
///
/// Units:
///   SI units and signs per ISO 8855 (x forward, y left, z up); each signal's comment states its
///   own.
/// Raw values:
///   They are unsigned; physical = raw * factor + offset. A signal with `has_sna` keeps all ones
///   for "not available" (NaN here). A value outside the range becomes the nearest end of the
///   range.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "modules/can/can_address.hpp"
#include "modules/can/can_state.hpp"

namespace plumb {

class ego_motion_t;
class ground_plane_t;
class mount_t;
class object_t;

inline constexpr std::size_t kMessageBytes = 8;
inline constexpr std::size_t kMaxSignals = 16;        ///< of one message
inline constexpr std::size_t kMaxSourceSignals = 40;  ///< that one source fills, of all messages

enum class ByteOrder : std::uint8_t { kIntel, kMotorola };

/// Where a signal lies in its message, and how it scales.
struct SignalLayout {
  int start_bit;  ///< as in a DBC: least significant bit (Intel), most significant bit (Motorola)
  int length;     ///< bits, at most 32
  double factor = 1.0;
  double offset = 0.0;
  bool has_sna = true;
  ByteOrder order = ByteOrder::kIntel;
};

/// Returns the largest raw value that stands for a physical one.
[[nodiscard]] constexpr std::uint64_t max_raw(const SignalLayout& layout) {
  return (std::uint64_t{1} << static_cast<unsigned>(layout.length)) - (layout.has_sna ? 2U : 1U);
}
/// Returns the raw value of "not available", all ones. @pre has_sna
[[nodiscard]] constexpr std::uint64_t sna_raw(const SignalLayout& layout) {
  return max_raw(layout) + 1;
}
[[nodiscard]] constexpr double min_physical(const SignalLayout& layout) { return layout.offset; }
[[nodiscard]] constexpr double max_physical(const SignalLayout& layout) {
  return static_cast<double>(max_raw(layout)) * layout.factor + layout.offset;
}

/// Returns the position in the message of bit `i` of the raw value, counted from its least
/// significant bit.
[[nodiscard]] constexpr unsigned bit_position(const SignalLayout& layout, int i) {
  if (layout.order == ByteOrder::kIntel) return static_cast<unsigned>(layout.start_bit + i);
  // Motorola counts from the most significant bit down, and on to the next byte's bit 7. With bytes
  // mirrored (7 - bit) that walk is one straight line.
  const int sawtooth = layout.start_bit / 8 * 8 + 7 - layout.start_bit % 8;
  const int straight = sawtooth + layout.length - 1 - i;
  return static_cast<unsigned>(straight / 8 * 8 + 7 - straight % 8);
}

/// Signals that belong to the frame, not to a source: encode() fills them.
enum class Framing : std::uint8_t { kCrc, kAliveCounter, kFrameCounter, kObjectIndex };

/// Reads one signal's physical value, NaN for "not available".
template <typename Source>
using Getter = double (*)(const Source&);

/// Where a value comes from, and when it is available.
struct SignalValue {
  std::variant<Framing, Getter<CanState>, Getter<ego_motion_t>, Getter<ground_plane_t>,
               Getter<mount_t>, Getter<CanObjectCounts>, Getter<object_t>>
      get;
  bool only_when_valid = false;
};

/// What a signal is read from: the number of the alternative in SignalValue::get.
enum class CanSource : std::uint8_t {
  kFraming,
  kState,
  kEgo,
  kPlane,
  kMountCheck,
  kObjectList,
  kObject,
};
inline constexpr std::size_t kNumSources = 7;

/// A value that is available whenever its source is; `Read` is a lambda without captures.
template <typename Source, typename Read>
constexpr SignalValue when_received(Read /*read*/) {
  return {Getter<Source>([](const Source& s) { return static_cast<double>(Read{}(s)); }), false};
}
/// A value that is available only while the source's status says that its values are valid.
template <typename Source, typename Read>
constexpr SignalValue when_valid(Read /*read*/) {
  return {Getter<Source>([](const Source& s) { return static_cast<double>(Read{}(s)); }), true};
}

/// One row of a message's table. For an object's signal `#` in name and comment stands for the
/// object's index.
struct Signal {
  const char* name;
  SignalLayout layout;
  const char* unit;
  SignalValue value;
  const char* comment;                      ///< meaning, axis and sign
  std::span<const char* const> names = {};  ///< of the raw values 0, 1, 2, ...
  const char* absence = "";                 ///< what "not available" means, where it needs saying
  bool names_are_flags = false;             ///< names belong to the bits of the raw value
};

[[nodiscard]] constexpr CanSource source_of(const Signal& signal) {
  return static_cast<CanSource>(signal.value.get.index());
}
[[nodiscard]] constexpr bool is_framing(const Signal& signal, Framing framing) {
  const Framing* const own = std::get_if<Framing>(&signal.value.get);
  return own != nullptr && *own == framing;
}

/// Returns whether the signals fit into the message, share no bit, and have room for all of their
/// named values. Each table has a static_assert of it.
[[nodiscard]] constexpr bool fit_message(std::span<const Signal> signals) {
  std::array<bool, 8 * kMessageBytes> taken{};
  if (signals.size() > kMaxSignals) return false;
  for (const Signal& signal : signals) {
    if (signal.layout.length < 1 || signal.layout.length > 32) return false;
    for (int i = 0; i < signal.layout.length; ++i) {
      const unsigned at = bit_position(signal.layout, i);
      if (at >= taken.size() || taken[at]) return false;
      taken[at] = true;
    }
    const std::size_t num_values =
        signal.names_are_flags ? std::size_t{1} << signal.names.size() : signal.names.size();
    if (num_values > max_raw(signal.layout) + 1) return false;
  }
  return true;
}

/// The signals of one message; `message` is its message_index().
struct SignalTable {
  std::size_t message;
  std::span<const Signal> signals;
};

/// A message as it is sent: its row, its address in this configuration, its signals.
struct Message {
  const MessageRow* row = nullptr;
  CanAddress address;
  std::span<const Signal> signals;
  /// Index of each signal's value in the SourceValues of its source.
  std::array<std::uint8_t, kMaxSignals> slot{};
};
using Messages = std::array<Message, kNumMessages>;

/// The values that one input gives to its signals, by slot. NaN: not available.
using SourceValues = std::array<double, kMaxSourceSignals>;
/// The values of one CAN message, by signal. NaN: not available.
using MessageValues = std::array<double, kMaxSignals>;

/// Returns the messages of one configuration. Throws what can_addresses() throws, and
/// std::logic_error when `tables` lacks a message or a source has more than kMaxSourceSignals.
[[nodiscard]] Messages make_messages(const CanConfig& config, std::span<const SignalTable> tables);

}  // namespace plumb
