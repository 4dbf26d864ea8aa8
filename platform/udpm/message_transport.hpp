/// What carries messages: the network, or memory within one process.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "platform/udpm/message_queues.hpp"
#include "platform/udpm/udpm_outcome.hpp"

namespace plumb {

class MessageTransport {
 public:
  MessageTransport() = default;
  virtual ~MessageTransport() = default;
  MessageTransport(const MessageTransport&) = delete;
  MessageTransport& operator=(const MessageTransport&) = delete;

  /// As MessageQueues.
  virtual int subscribe(const Subscription& wanted) = 0;
  virtual void unsubscribe(int subscription) = 0;
  [[nodiscard]] virtual std::int64_t num_skipped(int subscription) const = 0;
  [[nodiscard]] virtual std::size_t num_waiting(int subscription) const = 0;

  /// False when the message was not taken.
  virtual bool publish(std::string_view channel, std::span<const std::uint8_t> payload) = 0;

  /// Readable when take() may give a message.
  [[nodiscard]] virtual int fileno() = 0;
  /// As UdpmReceiver::take().
  [[nodiscard]] virtual MessageQueues::View take() = 0;

  /// [bytes] that the kernel holds for us; 0 before the first subscription and without a network.
  [[nodiscard]] virtual int receive_buffer_bytes() const { return 0; }
  /// Packets by what became of them.
  [[nodiscard]] virtual UdpmOutcomeCounts outcomes() const { return {}; }
  /// Packets that found the kernel's buffer full.
  [[nodiscard]] virtual std::int64_t num_overflowed() const { return 0; }
};

}  // namespace plumb
