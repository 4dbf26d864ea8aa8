/// Messages within one process (memq://), for tests: what is published is read by the same object.
#pragma once

#include "platform/clock.hpp"
#include "platform/udpm/message_transport.hpp"
#include "platform/udpm/ready_signal.hpp"

namespace plumb {

class MemoryTransport : public MessageTransport {
 public:
  int subscribe(const Subscription& wanted) override { return queues_.subscribe(wanted); }
  void unsubscribe(int subscription) override {
    queues_.unsubscribe(subscription);
    ready_.raise(!queues_.is_empty());
  }
  [[nodiscard]] std::int64_t num_skipped(int subscription) const override {
    return queues_.num_skipped(subscription);
  }
  [[nodiscard]] std::size_t num_waiting(int subscription) const override {
    return queues_.num_waiting(subscription);
  }
  /// False when the reader's slots are taken or the message is too large for them. A message that
  /// nobody reads counts as taken, as on a network.
  bool publish(std::string_view channel, std::span<const std::uint8_t> payload) override {
    const int subscription = queues_.find(channel);
    if (subscription == MessageQueues::kNone) return true;
    if (queues_.is_full(subscription) || payload.size() > queues_.max_bytes(subscription))
      return false;
    queues_.push(subscription, payload, monotonic_us());
    ready_.raise(true);
    return true;
  }
  [[nodiscard]] int fileno() override { return ready_.fileno(); }
  [[nodiscard]] MessageQueues::View take() override {
    const MessageQueues::View message = queues_.pop();
    ready_.raise(!queues_.is_empty());
    return message;
  }

 private:
  MessageQueues queues_;
  ReadySignal ready_;
};

}  // namespace plumb
