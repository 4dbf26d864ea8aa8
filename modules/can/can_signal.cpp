#include "modules/can/can_signal.hpp"

#include <stdexcept>

namespace plumb {

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
  return messages;
}

}  // namespace plumb
