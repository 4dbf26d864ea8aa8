#include "modules/can/can_signal.hpp"

#include <stdexcept>
#include <string>
#include <string_view>

namespace plumb {
namespace {

/// The slot of the signal with this name among those of the same source.
std::uint8_t slot_of(const Messages& messages, CanSource source, std::string_view name) {
  for (const Message& message : messages) {
    for (std::size_t s = 0; s < message.signals.size(); ++s) {
      const Signal& signal = message.signals[s];
      if (source_of(signal) == source && signal.name == name) return message.slot[s];
    }
  }
  throw std::logic_error("no signal " + std::string(name));
}

void find_deviations(Messages* messages) {
  for (Message& message : *messages) {
    message.deviation_slot.fill(kNoSlot);
    for (std::size_t s = 0; s < message.signals.size(); ++s) {
      const Signal& signal = message.signals[s];
      if (signal.value.deviation == nullptr) continue;
      message.deviation_slot[s] = slot_of(*messages, source_of(signal), signal.value.deviation);
    }
  }
}

}  // namespace

Messages make_messages(const CanConfig& config, std::span<const SignalTable> tables) {
  const std::array<CanAddress, kNumMessages> addresses = can_addresses(config);
  Messages messages;
  for (std::size_t i = 0; i < kNumMessages; ++i) {
    messages[i].row = &kMessageRows[i];
    messages[i].address = addresses[i];
  }
  for (const SignalTable& table : tables) messages[table.message].signals = table.signals;

  std::array<std::uint8_t, kNumSources> next{};
  for (Message& message : messages) {
    if (message.signals.empty()) {
      throw std::logic_error(std::string(message.row->name) + " has no signals");
    }
    for (std::size_t s = 0; s < message.signals.size(); ++s) {
      const CanSource source = source_of(message.signals[s]);
      if (source == CanSource::kFraming) continue;
      std::uint8_t& slot = next[static_cast<std::size_t>(source)];
      if (slot == kMaxSourceSignals) throw std::logic_error("kMaxSourceSignals is too small");
      message.slot[s] = slot++;
    }
  }
  find_deviations(&messages);
  return messages;
}

}  // namespace plumb
