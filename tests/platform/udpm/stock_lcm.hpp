/// liblcm as other programs use it, and waiting for messages of ours.
#pragma once

#include <lcm/lcm.h>
#include <poll.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "platform/clock.hpp"
#include "platform/udpm/udpm_receiver.hpp"

namespace plumb::test {

inline constexpr const char* kTestUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4000000";

struct Received {
  std::string channel;
  std::vector<std::uint8_t> bytes;
  bool operator==(const Received&) const = default;
};

class StockLcm {
 public:
  explicit StockLcm(const std::string& url = kTestUrl) : lcm_(lcm_create(url.c_str())) {
    if (lcm_ == nullptr) throw std::runtime_error("liblcm cannot use " + url);
  }
  ~StockLcm() { lcm_destroy(lcm_); }
  StockLcm(const StockLcm&) = delete;
  StockLcm& operator=(const StockLcm&) = delete;

  [[nodiscard]] bool publish(const std::string& channel, const std::vector<std::uint8_t>& bytes) {
    return lcm_publish(lcm_, channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size())) ==
           0;
  }
  void subscribe(const std::string& channel) {
    auto* subscription = lcm_subscribe(lcm_, channel.c_str(), &StockLcm::on_message, this);
    lcm_subscription_set_queue_capacity(subscription, 2'000);
  }
  /// Handles messages until `count` have come in total or none comes for a second.
  const std::vector<Received>& receive(std::size_t count) {
    while (received_.size() < count && lcm_handle_timeout(lcm_, 1'000) > 0) {
    }
    return received_;
  }

 private:
  static void on_message(const lcm_recv_buf_t* raw, const char* channel, void* self) {
    const auto* bytes = static_cast<const std::uint8_t*>(raw->data);
    static_cast<StockLcm*>(self)->received_.push_back({channel, {bytes, bytes + raw->data_size}});
  }
  lcm_t* lcm_;
  std::vector<Received> received_;
};

inline bool is_readable(int fd, int timeout_ms) {
  pollfd watched{fd, POLLIN, 0};
  return ::poll(&watched, 1, timeout_ms) == 1;
}

/// The next message; kNone when none comes within `timeout_ms`.
inline MessageQueues::View wait_for_message(UdpmReceiver* receiver, int timeout_ms = 2'000) {
  const std::int64_t end_us = monotonic_us() + timeout_ms * 1'000;
  while (true) {
    const MessageQueues::View message = receiver->take();
    if (message.subscription != MessageQueues::kNone) return message;
    const auto left_ms = static_cast<int>((end_us - monotonic_us()) / 1'000);
    if (left_ms <= 0) return message;
    (void)is_readable(receiver->fileno(), left_ms);
  }
}

}  // namespace plumb::test
