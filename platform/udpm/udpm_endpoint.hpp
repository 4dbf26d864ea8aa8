/// A program's end of a UDP multicast network: a sender, and a receiver from the first subscription
/// on. A program that only publishes does not join the group.
#pragma once

#include <optional>

#include "platform/udpm/message_transport.hpp"
#include "platform/udpm/udpm_receiver.hpp"
#include "platform/udpm/udpm_sender.hpp"

namespace plumb {

class UdpmEndpoint : public MessageTransport {
 public:
  /// Throws UdpmError.
  explicit UdpmEndpoint(UdpmUrl url) : url_(std::move(url)), sender_(url_) {}

  /// The first one joins the network. Throws as UdpmReceiver and MessageQueues::subscribe().
  int subscribe(const Subscription& wanted) override { return receiver().subscribe(wanted); }
  void unsubscribe(int subscription) override { receiver().unsubscribe(subscription); }
  [[nodiscard]] std::int64_t num_skipped(int subscription) const override {
    return receiver_ ? receiver_->inbox().num_skipped(subscription) : 0;
  }
  [[nodiscard]] std::size_t num_waiting(int subscription) const override {
    return receiver_ ? receiver_->inbox().num_waiting(subscription) : 0;
  }
  bool publish(std::string_view channel, std::span<const std::uint8_t> payload) override {
    return sender_.publish(channel, payload);
  }
  [[nodiscard]] int fileno() override { return receiver().fileno(); }
  [[nodiscard]] MessageQueues::View take() override { return receiver().take(); }
  [[nodiscard]] int receive_buffer_bytes() const override {
    return receiver_ ? receiver_->receive_buffer_bytes() : 0;
  }
  [[nodiscard]] UdpmOutcomeCounts outcomes() const override {
    return receiver_ ? receiver_->inbox().outcomes() : UdpmOutcomeCounts{};
  }
  [[nodiscard]] std::int64_t num_overflowed() const override {
    return receiver_ ? receiver_->num_overflowed() : 0;
  }

 private:
  UdpmReceiver& receiver() {
    if (!receiver_) receiver_.emplace(url_);
    return *receiver_;
  }

  UdpmUrl url_;
  UdpmSender sender_;
  std::optional<UdpmReceiver> receiver_;
};

}  // namespace plumb
