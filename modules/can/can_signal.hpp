/// A signal and a message as tables: what the codec, the gates and the DBC are made from.
///
/// Units:
///   SI units and signs per ISO 8855 (x forward, y left, z up); each signal's comment states its
///   own.
/// Raw values:
///   They are unsigned; physical = raw * factor + offset. A signal with `has_sna` keeps all ones
///   for "not available" (NaN here). A value outside the range is "not available", too; Beyond
///   names the exceptions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "modules/can/can_address.hpp"
#include "modules/can/can_state.hpp"

namespace plumb {

class mount_t;
class object_t;
struct JudgedMotion;
struct JudgedPlane;

inline constexpr std::size_t kMessageBytes = 8;
inline constexpr std::size_t kMaxSignals = 16;        ///< of one message
inline constexpr std::size_t kMaxSourceSignals = 48;  ///< that one source fills, of all messages
inline constexpr std::uint8_t kNoSlot = 0xFF;

enum class ByteOrder : std::uint8_t { kIntel, kMotorola };

/// What becomes of a value beyond the range of its signal.
enum class Beyond : std::uint8_t {
  kDrops,  ///< it is "not available"
  kStays,  ///< a count or a time that stays at the top of the range, as its comment says
  kWraps,  ///< a position or a length modulo the range
};

/// Where a signal lies in its message, and how it scales.
struct SignalLayout {
  int start_bit;  ///< as in a DBC: least significant bit (Intel), most significant bit (Motorola)
  int length;     ///< bits, at most 32
  double factor = 1.0;
  double offset = 0.0;
  bool has_sna = true;
  ByteOrder order = ByteOrder::kIntel;
  Beyond beyond = Beyond::kDrops;
  double modulus = 0.0;  ///< of a signal that wraps: its range is [offset, offset + modulus)
};
/// A signal that stays at the top of its range.
[[nodiscard]] constexpr SignalLayout staying(SignalLayout layout) {
  layout.beyond = Beyond::kStays;
  return layout;
}
/// A signal that is sent modulo `modulus`, which is a multiple of the factor.
[[nodiscard]] constexpr SignalLayout wrapping(SignalLayout layout, double modulus) {
  layout.beyond = Beyond::kWraps;
  layout.modulus = modulus;
  return layout;
}

/// Returns the largest raw value that stands for a physical one.
[[nodiscard]] constexpr std::uint64_t max_raw(const SignalLayout& layout) {
  if (layout.beyond == Beyond::kWraps) {
    return static_cast<std::uint64_t>(layout.modulus / layout.factor + 0.5) - 1;
  }
  return (std::uint64_t{1} << static_cast<unsigned>(layout.length)) - (layout.has_sna ? 2U : 1U);
}
/// Returns the raw value of "not available", all ones. @pre has_sna
[[nodiscard]] constexpr std::uint64_t sna_raw(const SignalLayout& layout) {
  return (std::uint64_t{1} << static_cast<unsigned>(layout.length)) - 1;
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

/// Values of one source whose availability hangs together, with one validity. The values of
/// kAlways are sent whenever their source is there.
enum class Group : std::uint8_t {
  kAlways,
  kMain,  ///< the plane; the mount's angles; speeds and rates of the motion
  kPose,  ///< the integrated pose of the motion
};
inline constexpr std::size_t kNumGroups = 3;

/// What the validity of a signal's group owes to it.
enum class Need : std::uint8_t {
  kNone,
  kWanted,      ///< without it the group is degraded at best; without all of them it is invalid
  kEssential,   ///< without it the group is invalid
  kIsValidity,  ///< it carries that validity
};

/// Where a value comes from, and when it is available.
struct SignalValue {
  std::variant<Framing, Getter<CanState>, Getter<JudgedMotion>, Getter<JudgedPlane>,
               Getter<mount_t>, Getter<CanObjectCounts>, Getter<object_t>>
      get;
  Group group = Group::kAlways;
  Need need = Need::kNone;
  /// Name of the signal with the value's standard deviation: they are sent together or not at all.
  const char* deviation = nullptr;
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
  return {Getter<Source>([](const Source& s) { return static_cast<double>(Read{}(s)); })};
}
/// A value that is available only while its group is not invalid.
template <typename Source, typename Read>
constexpr SignalValue when_valid(Read /*read*/, Group group = Group::kMain) {
  return {Getter<Source>([](const Source& s) { return static_cast<double>(Read{}(s)); }), group};
}
/// The validity of a group.
template <typename Source>
constexpr SignalValue validity_of_group(Group group) {
  return {Getter<Source>([](const Source&) { return kNotAvailable; }), group, Need::kIsValidity};
}
constexpr SignalValue wanted(SignalValue value) {
  value.need = Need::kWanted;
  return value;
}
constexpr SignalValue essential(SignalValue value) {
  value.need = Need::kEssential;
  return value;
}
constexpr SignalValue with_deviation(const char* signal, SignalValue value) {
  value.deviation = signal;
  return value;
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
    if (max_raw(signal.layout) >= (std::uint64_t{1} << static_cast<unsigned>(signal.layout.length)))
      return false;
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
  /// The same of its standard deviation; kNoSlot where it has none.
  std::array<std::uint8_t, kMaxSignals> deviation_slot{};
};
using Messages = std::array<Message, kNumMessages>;

/// The values that one input gives to its signals, by slot. NaN: not available.
using SourceValues = std::array<double, kMaxSourceSignals>;
/// The values of one CAN message, by signal. NaN: not available.
using MessageValues = std::array<double, kMaxSignals>;

/// Returns the messages of one configuration. Throws what can_addresses() throws, and
/// std::logic_error when `tables` lacks a message, names a deviation that does not exist, or has a
/// source with more than kMaxSourceSignals.
[[nodiscard]] Messages make_messages(const CanConfig& config, std::span<const SignalTable> tables);

}  // namespace plumb
